#pragma once
#include <functional>
#include <string_view>
#include <vector>

#include "modules/io/byte_buffer.hpp"
#include "modules/io/scalar.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::io {

/// A column of a cloud as a file stores it.
struct OutColumn {
  std::string_view name;
  Scalar type = Scalar::none;
  std::function<double(std::size_t point)> value;
};

/// All columns that the cloud has: x y z (true coordinates), normals, colours, intensity, label, source.
/// packed_colour: colours as one number `rgb`, and normals as normal_x …, as PCD has them.
std::vector<OutColumn> columns_of(const Cloud& cloud, bool packed_colour);

/// The header of a PLY file of these columns; with one sensor it has a camera, with more a list of them, whose places
/// (three doubles each) follow the points.
void write_ply_head(const std::vector<OutColumn>& columns, std::size_t points, std::size_t sensors, bool binary,
                    ByteBuffer& out);

/// Writes the points one after the other, in the machine's byte order.
void write_records(const std::vector<OutColumn>& columns, std::size_t points, ByteBuffer& out);
/// Writes a line a point, with the shortest digits that give the same numbers again.
void write_lines(const std::vector<OutColumn>& columns, std::size_t points, char separator, ByteBuffer& out);

}  // namespace atrium::io
