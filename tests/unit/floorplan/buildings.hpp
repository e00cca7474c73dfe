#pragma once
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "modules/floorplan/project.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::floorplan {

/// Puts structural meshes together, rectangle by rectangle, each of a primitive of its own.
class MeshBuilder {
 public:
  Mesh mesh;
  std::int32_t storey = 0;

  void add(SurfaceClass surface, const std::vector<Eigen::Vector3d>& ring, bool new_primitive = true) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), ring.begin(), ring.end());
    if (new_primitive) ++primitive_;
    for (std::uint32_t i = 2; i < ring.size(); ++i) {
      mesh.triangles.push_back({first, first + i - 1, first + i});
      mesh.classes.push_back(surface);
      mesh.storeys.push_back(storey);
      mesh.primitives.push_back(primitive_);
    }
  }
  /// A wall's face along (x0, y0) → (x1, y1), seen from its left.
  void wall(double x0, double y0, double x1, double y1, double low = 0, double high = 2.5, bool new_primitive = true) {
    add(SurfaceClass::wall, {{x0, y0, low}, {x0, y0, high}, {x1, y1, high}, {x1, y1, low}}, new_primitive);
  }
  void floor(double x0, double y0, double x1, double y1, double z = 0) {
    add(SurfaceClass::floor, {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}});
  }
  void ceiling(double x0, double y0, double x1, double y1, double z = 2.5) {
    add(SurfaceClass::ceiling, {{x0, y0, z}, {x0, y1, z}, {x1, y1, z}, {x1, y0, z}});
  }
  void room(double x0, double y0, double x1, double y1, double low = 0, double high = 2.5) {
    floor(x0, y0, x1, y1, low);
    ceiling(x0, y0, x1, y1, high);
    wall(x0, y0, x1, y0, low, high);
    wall(x1, y0, x1, y1, low, high);
    wall(x1, y1, x0, y1, low, high);
    wall(x0, y1, x0, y0, low, high);
  }

 private:
  std::int32_t primitive_ = -1;
};

/// Two rooms, 4 m × 3 m and 2.88 m × 3 m, with a wall of 12 cm between them.
inline Mesh two_rooms() {
  MeshBuilder b;
  b.room(0, 0, 4, 3);
  b.room(4.12, 0, 7, 3);
  return b.mesh;
}

/// Keeps warnings, and files in a folder of its own.
class Host : public ContextHost {
 public:
  test::TemporaryFolder folder;
  std::vector<std::string> warnings;
  std::vector<std::filesystem::path> written;
  std::filesystem::path output_folder() override { return folder.path(); }
  void log(Level level, std::string_view text) override {
    if (level == Level::warning) warnings.emplace_back(text);
  }
  void wrote(const std::filesystem::path& file) override { written.push_back(file); }
};

inline FloorPlan plan_of(const Mesh& mesh, const Project::Params& params = {}, std::vector<std::string>* warnings = {},
                         OptionalInput<Transform> transform = {}) {
  const auto host = std::make_shared<Host>();
  Context context(1, host);
  FloorPlan plan = Project::run({input(mesh), std::move(transform)}, params, context).plan;
  if (warnings != nullptr) *warnings = host->warnings;
  return plan;
}

/// `count` rooms of width × height side by side, with walls of 12 cm between them.
inline Mesh row_of_rooms(double width, double height, int count) {
  MeshBuilder b;
  for (int i = 0; i < count; ++i) b.room(i * (width + 0.12), 0, i * (width + 0.12) + width, height);
  return b.mesh;
}

/// One room of 5 m × 4 m on each storey.
inline FloorPlan tower(int storeys) {
  MeshBuilder b;
  for (b.storey = 0; b.storey < storeys; ++b.storey) b.room(0, 0, 5, 4, 3.0 * b.storey, 3.0 * b.storey + 2.6);
  return plan_of(b.mesh);
}

/// Adds to a storey of two_rooms a door between them, a window in the first room's lower wall and holes in its floor
/// and ceiling.
inline void add_openings(FloorPlan& plan, std::size_t storey) {
  const Eigen::Vector2d origin = plan.origin.head<2>();
  const auto add = [&](PlanOpening opening) {
    opening.from -= origin;
    opening.to -= origin;
    for (auto& p : opening.outline) p -= origin;
    plan.storeys.at(storey).openings.push_back(std::move(opening));
  };
  // Room 1 (12 m²) lies at the door's left.
  add({"door", {4.06, 0.5}, {4.06, 1.4}, {{4, 0.5}, {4.12, 0.5}, {4.12, 1.4}, {4, 1.4}}, 0, 1, 0, 2.1, 0.12});
  add({"window", {1, 0}, {2.5, 0}, {}, 0, -1, 0.9, 1.2, 0});
  add({"slab", {}, {}, {{1, 1}, {2, 1}, {2, 2}, {1, 2}}, 0, -1, 0, 0, 0});
  add({"slab", {}, {}, {{2.5, 1}, {3.5, 1}, {3.5, 2}, {2.5, 2}}, 0, -1, 2.5, 0, 0.3});
}

inline FloorPlan with_openings() {
  FloorPlan plan = plan_of(two_rooms());
  add_openings(plan, 0);
  return plan;
}

inline double total_area(const std::vector<PlanPolygon>& polygons) {
  double sum = 0;
  for (const auto& polygon : polygons) sum += polygon.area();
  return sum;
}

}  // namespace atrium::floorplan
