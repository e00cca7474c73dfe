#pragma once
#include <unistd.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/types/mesh.hpp"
#include "modules/types/picture.hpp"
#include "modules/types/plane_meshes.hpp"

namespace atrium::render {

namespace fs = std::filesystem;

/// A folder for a node's files, removed with the test.
class Folder : public ContextHost {
 public:
  Folder() : path_(fs::temp_directory_path() / ("atrium-render-" + std::to_string(::getpid()))) {
    fs::create_directories(path_);
  }
  ~Folder() override { fs::remove_all(path_); }
  fs::path output_folder() override { return path_; }
  fs::path path_;
};

/// A room of 4 × 3 × 2.5 m, seen from inside, as planar meshes.
inline PlaneMeshes room(const Eigen::Vector3d& origin) {
  PlaneMeshes meshes;
  meshes.origin = origin;
  const auto add = [&](SurfaceClass surface, std::vector<Eigen::Vector3d> corners) {
    PlaneMesh mesh;
    mesh.primitive = static_cast<std::int32_t>(meshes.meshes.size());
    mesh.surface = surface;
    mesh.plane.normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    mesh.plane.offset = -mesh.plane.normal.dot(corners[0]);
    mesh.corners = std::move(corners);
    meshes.meshes.push_back(mesh);
  };
  add(SurfaceClass::floor, {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}});
  add(SurfaceClass::ceiling, {{0, 3, 2.5}, {4, 3, 2.5}, {4, 0, 2.5}, {0, 0, 2.5}});
  add(SurfaceClass::wall, {{4, 0, 0}, {0, 0, 0}, {0, 0, 2.5}, {4, 0, 2.5}});
  add(SurfaceClass::wall, {{0, 3, 0}, {4, 3, 0}, {4, 3, 2.5}, {0, 3, 2.5}});
  add(SurfaceClass::wall, {{0, 0, 0}, {0, 3, 0}, {0, 3, 2.5}, {0, 0, 2.5}});
  add(SurfaceClass::wall, {{4, 3, 0}, {4, 0, 0}, {4, 0, 2.5}, {4, 3, 2.5}});
  return meshes;
}

/// One square of 4 × 4 m on the floor, primitive 0.
inline Mesh square(const Eigen::Vector3d& origin) {
  Mesh mesh;
  mesh.origin = origin;
  mesh.vertices = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.classes = {SurfaceClass::floor, SurfaceClass::floor};
  mesh.primitives = {0, 0};
  return mesh;
}

inline Colour pixel(const Picture& picture, double x, double y) {
  const auto column = static_cast<std::size_t>(x * picture.width);
  const auto row = static_cast<std::size_t>(y * picture.height);
  const auto* p = &picture.pixels[3 * (row * static_cast<std::size_t>(picture.width) + column)];
  return {p[0], p[1], p[2]};
}

inline bool same_hue(const Colour& a, const Colour& b) {
  const Eigen::Vector3d x(a[0], a[1], a[2]);
  const Eigen::Vector3d y(b[0], b[1], b[2]);
  return x.normalized().dot(y.normalized()) > 0.98 && x.norm() > 60;
}

/// What share of the pixels has this colour.
inline double share_of(const Picture& picture, const Colour& colour) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < picture.pixels.size(); i += 3)
    if (std::equal(colour.begin(), colour.end(), picture.pixels.begin() + static_cast<std::ptrdiff_t>(i))) ++count;
  return 3.0 * static_cast<double>(count) / static_cast<double>(picture.pixels.size());
}

}  // namespace atrium::render
