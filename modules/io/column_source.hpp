#pragma once
#include "graph/api/context.hpp"
#include "modules/io/point_source.hpp"

namespace atrium::io {

/// The points of a geometry with columns in memory or in a mapped file, or with rows that are not read yet, in blocks.
class ColumnSource : public PointSource {
 public:
  enum class Wanted { all, positions };
  /// The geometry outlives the source.
  ColumnSource(const RawGeometry& geometry, const Context& context, Wanted wanted = Wanted::all);
  std::size_t blocks() const override {
    return geometry_.rows ? geometry_.rows->blocks() : (geometry_.count + block_size - 1) / block_size;
  }
  std::size_t capacity(std::size_t block) const override;
  void read(std::size_t block, PointBlock& to) const override;

 private:
  bool is_there(Role role) const;
  void fill(const RawGeometry& columns, std::size_t first, PointBlock& to) const;
  void check_sources(std::size_t first, const std::vector<double>& sources, std::size_t count) const;

  static constexpr std::size_t block_size = 16384;
  const RawGeometry& geometry_;
  double colour_factor_ = 1;
  bool packed_ = false;            ///< the colours are one number
  std::vector<Role> rows_wanted_;  ///< of the columns of rows, `none` for others
};

}  // namespace atrium::io
