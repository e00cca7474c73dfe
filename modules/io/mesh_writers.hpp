#pragma once
#include <string>

#include "graph/api/context.hpp"
#include "modules/io/face_images.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::io {

/// Throws Error unless every vertex is finite, every corner is a vertex and every column is empty or of full length.
void check_mesh(const Mesh& mesh);

/// Unit normal of a triangle; zero where it has no area.
Eigen::Vector3d normal_of(const Mesh& mesh, std::size_t triangle);

/// PLY: vertices double x, y, z with the origin added (exact where georeferenced), colours if any; faces with `class`
/// (uchar, see the comments in the file), red, green, blue of the class, `storey` and `primitive` (int) as far as the
/// mesh has them.
void write_ply(const Mesh& mesh, bool binary, AtomicFile& file);

/// OBJ: all digits of the coordinates with the origin added, vertex colours as x y z r g b; a group (see obj_groups)
/// and a material per class and primitive, so faces are sorted by these; texture coordinates (vt) where there is an
/// image. Storeys are not kept.
void write_obj(const Mesh& mesh, const FaceImages& images, const std::string& material_file, AtomicFile& file);
/// The text of the material file that write_obj names: a material per class ("wall"), and one per image ("wall_12")
/// that names the file image_prefix + "wall_12.png".
std::string obj_materials(const FaceImages& images, const std::string& image_prefix);

/// GLB (glTF 2.0 in one file); see WriteMesh for its form. `up`: of unit length, in the mesh's frame. `crs`: the name
/// of the coordinate reference system of true coordinates, or empty. Errors: more than 2 GiB.
void write_glb(const Mesh& mesh, const FaceImages& images, const Eigen::Vector3d& up, const std::string& crs,
               AtomicFile& file);

/// Furthest coordinate that a binary STL file may have, metres: float32 resolves half a millimetre there.
inline constexpr double stl_limit = 8192.0;
/// STL: triangles with their normals and nothing else. Text has all digits; binary has float32, so a mesh beyond
/// stl_limit is an Error instead of a silent loss.
void write_stl(const Mesh& mesh, bool binary, AtomicFile& file);

}  // namespace atrium::io
