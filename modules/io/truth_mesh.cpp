#include <Eigen/Geometry>
#include <map>

#include "modules/geometry/plane_frame.hpp"
#include "modules/geometry/triangulate.hpp"
#include "modules/io/truth_json.hpp"

namespace atrium::io {
namespace {

constexpr double snap = 1e-9;  // metres: heights that differ by a rounding error are one

// The longest side's direction as first axis: most corners then stand at few heights.
PlaneFrame frame_of(const TrueFace& face) {
  PlaneFrame frame;
  frame.origin = face.outline.front();
  double longest = 0;
  for (std::size_t i = 0; i < face.outline.size(); ++i) {
    const Eigen::Vector3d side = face.outline[(i + 1) % face.outline.size()] - face.outline[i];
    if (side.norm() <= longest) continue;
    longest = side.norm();
    frame.u = side.normalized();
  }
  const Eigen::Vector3d normal = area_vector(face.outline).normalized();
  frame.v = normal.cross(frame.u).normalized();
  return frame;
}

double snapped(std::map<double, double>& known, double value) {
  const auto near = known.lower_bound(value - snap);
  if (near != known.end() && near->first <= value + snap) return near->first;
  known.emplace(value, value);
  return value;
}

void add_face(Mesh& mesh, const TrueFace& face, std::int32_t index) {
  const PlaneFrame frame = frame_of(face);
  std::vector<std::vector<Eigen::Vector2d>> rings;
  std::map<std::pair<double, double>, Eigen::Vector3d> corners;
  std::map<double, double> across, along;
  const auto add = [&](const std::vector<Eigen::Vector3d>& ring) {
    rings.emplace_back();
    for (const auto& p : ring) {
      const Eigen::Vector2d flat = frame.to_plane(p);
      rings.back().emplace_back(snapped(across, flat.x()), snapped(along, flat.y()));
      corners.emplace(std::pair{rings.back().back().x(), rings.back().back().y()}, p);
    }
  };
  add(face.outline);
  for (const auto& hole : face.holes) add(hole);
  const auto pieces = triangulate(rings);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const auto& p : pieces.points) {
    const auto corner = corners.find({p.x(), p.y()});
    mesh.vertices.push_back(corner != corners.end() ? corner->second : frame.to_space(p));
  }
  for (const auto& [a, b, c] : pieces.triangles) {
    mesh.triangles.push_back({first + a, first + b, first + c});
    mesh.classes.push_back(face.surface);
    mesh.storeys.push_back(face.storey);
    mesh.primitives.push_back(index);
  }
}

}  // namespace

Mesh mesh_of(const GroundTruth& truth) {
  Mesh mesh;
  mesh.origin = truth.origin;
  for (std::size_t i = 0; i < truth.faces.size(); ++i) add_face(mesh, truth.faces[i], static_cast<std::int32_t>(i));
  return mesh;
}

TrueFace face_of(SurfaceClass surface, std::int32_t room, std::int32_t storey, std::vector<Eigen::Vector3d> outline) {
  TrueFace face;
  face.surface = surface;
  face.room = room;
  face.storey = storey;
  face.outline = std::move(outline);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& p : face.outline) mean += p / static_cast<double>(face.outline.size());
  face.plane.normal = area_vector(face.outline).normalized();
  face.plane.offset = -face.plane.normal.dot(mean);
  return face;
}

}  // namespace atrium::io
