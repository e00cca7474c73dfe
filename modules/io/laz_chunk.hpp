#pragma once
#include <cstddef>
#include <memory>

#include "modules/io/las_point.hpp"

namespace atrium::io {

/// The points of one chunk of a LAZ file, one after the other.
class LazChunk {
 public:
  LazChunk() = default;
  virtual ~LazChunk() = default;
  LazChunk(const LazChunk&) = delete;
  LazChunk& operator=(const LazChunk&) = delete;
  /// The next point. Behind the end of the bytes it is anything.
  virtual const LasPoint& next() = 0;
  /// Whether more was asked for than the bytes hold: they are damaged.
  virtual bool exhausted() const = 0;
};

/// Compressor 2, record types 0 … 3. `extra`: bytes of a record after those of its type. There are bytes for the first
/// record at least.
std::unique_ptr<LazChunk> pointwise_chunk(const std::byte* data, std::size_t size, int type, std::size_t extra);
/// Compressor 3, record types 6 … 8. `points`: the number that is to be in the chunk. Throws std::out_of_range, with
/// what is wrong, if the layers do not fit into the bytes or the chunk says that it has another number of points.
std::unique_ptr<LazChunk> layered_chunk(const std::byte* data, std::size_t size, int type, std::size_t extra,
                                        std::size_t points);

}  // namespace atrium::io
