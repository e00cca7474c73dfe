#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "graph/api/context.hpp"

namespace atrium::io {

/// LASzip's compressor 2 (pointwise, in chunks of 50 000 points) for records of type 0 (20 bytes) or 2 (26 bytes).
struct LazWriter {
  static constexpr std::uint32_t points_of_chunk = 50000;
  /// What the record "laszip encoded" 22204 holds.
  static std::string description(int type);
  /// The compressed points with their table. `records`: the points one after the other; `begin`: the byte of the file
  /// at which the result is to stand. Chunks are compressed side by side, with the same bytes for any number of
  /// threads.
  static std::string compressed(const std::string& records, int type, std::uint64_t begin, const Context& context);
};

}  // namespace atrium::io
