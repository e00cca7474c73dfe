#pragma once
#include <memory>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/io/las_header.hpp"
#include "modules/io/las_point.hpp"
#include "modules/io/laz_chunk.hpp"
#include "modules/io/point_source.hpp"

namespace atrium::io {

/// The points of a LAS file (in runs of records) or LAZ file (in its chunks). What is kept, and how: read_las.
class LasSource : public PointSource {
 public:
  LasSource(std::shared_ptr<const MappedFile> file, const LasHeader& header, const Context& context);

  std::size_t blocks() const override { return runs_.size(); }
  std::size_t capacity(std::size_t block) const override { return runs_[block].points; }
  void read(std::size_t block, PointBlock& to) const override;
  std::size_t samples() const override { return header_.compressed ? 5 : 40; }

 private:
  struct Run {
    std::size_t begin = 0, size = 0;  ///< bytes
    std::size_t points = 0;
  };

  void find_chunks();
  std::vector<Run> chunk_table(std::size_t at, std::size_t end) const;
  void find_white(const Context& context);
  bool is_wide(std::size_t block) const;
  /// Calls take(point) for the points of a block.
  template <class F>
  void for_points(std::size_t block, F&& take) const;

  std::shared_ptr<const MappedFile> file_;
  LasHeader header_;
  LasRecord type_;
  std::vector<Run> runs_;
  double white_ = 255;  ///< of the colours: 255 or 65535
};

}  // namespace atrium::io
