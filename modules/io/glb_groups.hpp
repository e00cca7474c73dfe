#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "modules/types/mesh.hpp"

namespace atrium::io {

/// Triangles of one class, storey and source primitive.
struct GlbGroup {
  SurfaceClass surface = SurfaceClass::object;
  std::int32_t storey = -1, primitive = -1;
  std::vector<std::uint32_t> triangles;
};
/// All triangles, by class, storey and primitive; in a group in the mesh's order.
std::vector<GlbGroup> glb_groups(const Mesh& mesh);

/// The normal of a group of one plane, of unit length; nothing where the group is none or has no area.
std::optional<Eigen::Vector3d> common_normal(const Mesh& mesh, const GlbGroup& group);

/// Numbers the vertices of groups of triangles from 0.
class GroupCorners {
 public:
  explicit GroupCorners(std::size_t vertices) : numbers_(vertices, none) {}
  struct Used {
    std::vector<std::uint32_t> vertices;  ///< of the mesh, each once
    std::vector<std::uint32_t> corners;   ///< three per triangle, into `vertices`
  };
  Used gather(const Mesh& mesh, const std::vector<std::uint32_t>& triangles);

 private:
  static constexpr std::uint32_t none = 0xffffffffU;
  std::vector<std::uint32_t> numbers_;
};

/// What is subtracted from true coordinates, so that float32 keeps a tenth of a millimetre: zero if all lie within a
/// kilometre of it; else the mesh's origin if all lie within a kilometre of that, so that meshes of one run fit
/// together; else whole metres in the middle.
Eigen::Vector3d glb_offset(const Mesh& mesh);
/// The same for what lies in `box` about `origin`.
Eigen::Vector3d glb_offset(const Eigen::Vector3d& origin, const Eigen::AlignedBox3d& box);

/// The rotation that brings `up` (unit length) to glTF's +y: by quarter turns that bring the nearest axis there, so
/// that z up becomes (x, z, -y) and y up stays; then, if `up` is more than 5 degrees from that axis, by the least
/// rotation.
Eigen::Matrix3d glb_rotation(const Eigen::Vector3d& up);

/// glTF wants factors and vertex colours linear, not as sRGB.
std::array<double, 3> linear(const Colour& colour);
std::array<std::uint16_t, 4> linear16(const Colour& colour);

}  // namespace atrium::io
