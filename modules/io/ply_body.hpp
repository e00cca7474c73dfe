#pragma once
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
bool is_corner_list(const PlyProperty& property);
/// 0, 1, 2 for x, y, z, else -1.
int sensor_axis(const PlyProperty& property);
/// Whether it is an element `sensor` with x, y and z and without lists (others' may be something else). Throws Error if
/// it is longer than `source` can count.
bool is_sensors(const std::string& path, const PlyElement& element);
/// 0, 1, 2 for view_px, view_py, view_pz, else -1.
int viewpoint_axis(const PlyProperty& property);

}  // namespace atrium::io
