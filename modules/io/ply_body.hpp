#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "graph/api/context.hpp"
#include "graph/api/mapped_file.hpp"
#include "modules/io/ply_header.hpp"
#include "modules/io/raw_geometry.hpp"

namespace atrium::io {

/// The data of a PLY file after its header: the geometry's columns and faces. `geometry.count` is set by the caller.
void read_ply_binary(const MappedFile& file, const PlyHeader& header, RawGeometry& geometry);
void read_ply_text(const MappedFile& file, const PlyHeader& header, RawGeometry& geometry, const Context& context);

/// Roles of an element's properties; a role is given to the first property that claims it.
std::vector<Role> roles_of(const PlyElement& element);

/// What the records of an element are to us.
enum class PlyPart : std::uint8_t { vertices, faces, strips, sensors, camera, other };
PlyPart part_of(const std::string& path, const PlyElement& element);
/// Warns where records with corners are not read: an unknown element that has such a list, or faces without one.
void warn_of_unread(const std::string& path, const PlyElement& element, const Context& context);

/// The body of a text file with one record a line, if its numbers are all there but broken into lines in another way
/// (one number a line, or several records a line); else nothing.
std::optional<std::string> one_record_a_line(std::string_view body, const PlyHeader& header);

bool is_corner_list(const PlyProperty& property);
/// 0, 1, 2 for x, y, z, else -1.
int sensor_axis(const PlyProperty& property);
/// Whether it is an element `sensor` with x, y and z and without lists (others' may be something else). Throws Error if
/// it is longer than `source` can count.
bool is_sensors(const std::string& path, const PlyElement& element);
/// 0, 1, 2 for view_px, view_py, view_pz, else -1.
int viewpoint_axis(const PlyProperty& property);

}  // namespace atrium::io
