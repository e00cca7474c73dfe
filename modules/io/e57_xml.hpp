#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace atrium::io {

/// One field of a scan's records: how its numbers are stored.
struct E57Field {
  enum class Kind : std::uint8_t { f32, f64, integer, text };
  std::string name;  ///< without the prefix of a namespace
  Kind kind = Kind::f64;
  std::int64_t minimum = 0, maximum = 0;  ///< of integers as they are stored
  double scale = 1, offset = 0;           ///< value = scale · integer + offset
  unsigned bits = 64;                     ///< per record; 0: each value is `minimum`. Not for text
};

/// Smallest and largest value of a colour channel or of the intensity.
struct E57Limits {
  double low = 0, high = 0;
};

/// One scan of an E57 file, as its XML section describes it.
struct E57Scan {
  std::string label;                       ///< for messages: "scan 2 'hall'"
  std::uint64_t section = 0, records = 0;  ///< physical offset of the points
  std::vector<E57Field> fields;
  std::optional<Eigen::Isometry3d> pose;  ///< scanner's frame to the file's; none: the file states none
  std::array<std::optional<E57Limits>, 3> colour_limits;
  std::optional<E57Limits> intensity_limits;

  /// Index of the field of that name, or -1.
  int field(std::string_view name) const;
};

struct E57Contents {
  std::vector<E57Scan> scans;  ///< those with points
  std::size_t all_scans = 0;
  std::size_t images = 0;
  std::string crs;  ///< coordinateMetadata: WKT, if given
};

/// Reads the XML section of an E57 file; prefixes of namespaces need not be declared, what is not known is passed over.
/// Throws Error, with the file and the scan, for XML that is none, for records without a place or without numbers, and
/// for poses that are no turn or not finite.
E57Contents read_e57_xml(const std::string& path, std::string xml);

}  // namespace atrium::io
