#include "modules/building/face_distances.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "modules/geometry/triangle_tree.hpp"

namespace atrium::building {
namespace {

constexpr double beside =
    0.005;  // metres: points whose foot lies further outside of the face are of a reveal or a jamb

struct Nearest {
  std::int32_t face = -1;
  float distance = 0;
};

Eigen::Vector3d normal_of(const Mesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
}

/// Frames and areas of the faces; a face's normal is the mean of its triangles'.
std::vector<Eigen::Vector3d> measure(const Mesh& mesh, std::vector<FaceDistances>& faces) {
  std::vector<Eigen::Vector3d> normals(faces.size(), Eigen::Vector3d::Zero());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto f = static_cast<std::size_t>(mesh.primitives[t]);
    if (normals[f].isZero()) faces[f].origin = mesh.vertices[mesh.triangles[t][0]];
    normals[f] += normal_of(mesh, t);
    faces[f].area += 0.5 * normal_of(mesh, t).norm();
  }
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (normals[f].norm() > 0) normals[f].normalize();
    Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(normals[f]);
    faces[f].across = across.norm() > 0.1 ? across.normalized() : Eigen::Vector3d::UnitX();
    faces[f].up = normals[f].cross(faces[f].across);
    faces[f].low.setConstant(1e300);
    faces[f].high.setConstant(-1e300);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    FaceDistances& face = faces[static_cast<std::size_t>(mesh.primitives[t])];
    for (const auto v : mesh.triangles[t]) {
      const Eigen::Vector3d d = mesh.vertices[v] - face.origin;
      const Eigen::Vector2d p(face.across.dot(d), face.up.dot(d));
      face.low = face.low.cwiseMin(p);
      face.high = face.high.cwiseMax(p);
    }
  }
  return normals;
}

}  // namespace

std::vector<FaceDistances> face_distances(const Mesh& mesh, const Cloud& cloud, std::size_t step, std::size_t count,
                                          double reach, double cell, const Context& context) {
  std::vector<FaceDistances> faces(count);
  const std::vector<Eigen::Vector3d> normals = measure(mesh, faces);
  const TriangleTree tree(mesh.vertices, mesh.triangles);
  const Eigen::Vector3d shift = cloud.origin - mesh.origin;
  std::vector<Nearest> nearest((cloud.size() + step - 1) / step);
  context.parallel_for(nearest.size(), [&](std::size_t begin, std::size_t end) {
    std::uint32_t hint = TriangleTree::none;
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d p = cloud.points[i * step].cast<double>() + shift;
      const auto found = tree.nearest(p, reach * reach, hint);
      if (!found) continue;
      hint = found.triangle;
      const std::int32_t f = mesh.primitives[found.triangle];
      const auto face = static_cast<std::size_t>(f);
      const double distance = normals[face].dot(p - faces[face].origin);
      if (found.squared_distance - distance * distance > beside * beside) continue;
      nearest[i] = {f, static_cast<float>(distance)};
    }
  });
  std::vector<std::map<std::pair<std::int32_t, std::int32_t>, std::pair<double, std::uint32_t>>> squares(count);
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    if (nearest[i].face < 0) continue;
    const auto f = static_cast<std::size_t>(nearest[i].face);
    faces[f].signed_distances.push_back(nearest[i].distance);
    const Eigen::Vector3d d = cloud.points[i * step].cast<double>() + shift - faces[f].origin;
    const auto place = [&](double at, double low) { return static_cast<std::int32_t>(std::floor((at - low) / cell)); };
    auto& [sum, points] =
        squares[f][{place(faces[f].up.dot(d), faces[f].low.y()), place(faces[f].across.dot(d), faces[f].low.x())}];
    sum += nearest[i].distance;
    ++points;
  }
  for (std::size_t f = 0; f < count; ++f)
    for (const auto& [place, sum] : squares[f])
      faces[f].squares.push_back({place.second, place.first, sum.first / sum.second});
  return faces;
}

}  // namespace atrium::building
