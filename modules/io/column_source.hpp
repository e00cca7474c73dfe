#pragma once
#include "graph/api/context.hpp"
#include "modules/io/point_source.hpp"

namespace atrium::io {

/// The points of a geometry with columns in memory or in a mapped file, in blocks.
class ColumnSource : public PointSource {
 public:
  /// The geometry outlives the source.
  ColumnSource(const RawGeometry& geometry, const Context& context);
  std::size_t blocks() const override { return (geometry_.count + block_size - 1) / block_size; }
  std::size_t capacity(std::size_t block) const override;
  void read(std::size_t block, PointBlock& to) const override;

 private:
  static constexpr std::size_t block_size = 16384;
  const RawGeometry& geometry_;
  double colour_factor_ = 1;
  bool packed_ = false;  ///< the colours are one number
};

}  // namespace atrium::io
