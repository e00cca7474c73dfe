#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "graph/api/mapped_file.hpp"
#include "modules/io/scalar.hpp"

namespace atrium::io {

struct PcdField {
  std::string name;
  Scalar type = Scalar::f32;
  std::uint64_t count = 1;   ///< numbers of the field in each point
  std::uint64_t offset = 0;  ///< in a point's record, bytes
  std::uint64_t size() const { return size_of(type) * count; }
};

struct PcdHeader {
  enum class Data : std::uint8_t { ascii, binary, compressed };
  std::vector<PcdField> fields;
  std::uint64_t points = 0, width = 0, height = 1;
  std::uint64_t record = 0;  ///< bytes of a point
  std::optional<Eigen::Vector3d> viewpoint;
  Data data = Data::ascii;
  std::size_t body = 0;   ///< byte where the data begin
  std::size_t lines = 0;  ///< of the header
};

/// Reads the header of a PCD file of version 0.5 to 0.7; upper and lower case are the same. Throws Error with the
/// line's number.
PcdHeader read_pcd_header(const MappedFile& file);

}  // namespace atrium::io
