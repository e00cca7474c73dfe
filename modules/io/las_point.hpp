#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace atrium::io {

/// What is read of a LAS record, as it is stored.
struct LasPoint {
  std::int32_t x = 0, y = 0, z = 0;  ///< times the header's scale, plus its offset
  std::uint16_t intensity = 0;
  std::uint8_t classification = 0;
  bool withheld = false;               ///< its producer says that it is not to be used
  std::array<std::uint16_t, 3> rgb{};  ///< if the record has colours
};

/// Where the fields of a record type stand, in bytes; -1: it has none.
struct LasRecord {
  int size = 0;  ///< without extra bytes
  int gps = -1, rgb = -1, nir = -1, waveform = -1;
  bool extended = false;  ///< types 6 … 10: other flags, classification of 8 bits
};
/// Of types 0 … 10.
constexpr std::array<LasRecord, 11> las_records{{{20, -1, -1, -1, -1, false},
                                                 {28, 20, -1, -1, -1, false},
                                                 {26, -1, 20, -1, -1, false},
                                                 {34, 20, 28, -1, -1, false},
                                                 {57, 20, -1, -1, 28, false},
                                                 {63, 20, 28, -1, 34, false},
                                                 {30, 22, -1, -1, -1, true},
                                                 {36, 22, 30, -1, -1, true},
                                                 {38, 22, 30, 36, -1, true},
                                                 {59, 22, -1, -1, 30, true},
                                                 {67, 22, 30, 36, 38, true}}};

/// Reads a record from its bytes, of which there are las_records[type].size at least.
LasPoint las_point(const std::byte* record, const LasRecord& type);

}  // namespace atrium::io
