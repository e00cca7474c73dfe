#include "modules/layout/face_grid.hpp"

#include <algorithm>
#include <cmath>

#include "modules/layout/raster.hpp"
#include "modules/types/ground_truth.hpp"

namespace atrium::layout {
namespace {

using Rings = std::vector<std::vector<Eigen::Vector2d>>;

constexpr double square = 0.25;     // metres
constexpr double same_way = 0.966;  // cosine of 15 degrees: a plane of the face looks the same way
constexpr double on_wall = 0.15;    // metres: walls lean, bend and drift by this much; their other sides look away
constexpr double on_level = 0.10;   // metres: floors and ceilings

std::vector<Eigen::Vector3d> places(const Building& building, const std::vector<std::uint32_t>& ring) {
  std::vector<Eigen::Vector3d> result;
  result.reserve(ring.size());
  for (const auto v : ring) result.push_back(building.vertices[v]);
  return result;
}

std::vector<Eigen::Vector2d> flat(const PlaneFrame& frame, const std::vector<Eigen::Vector3d>& ring) {
  std::vector<Eigen::Vector2d> result;
  result.reserve(ring.size());
  for (const auto& p : ring) result.push_back(frame.to_plane(p));
  return result;
}

/// The face's squares, none of them seen. A face without an area has none.
FaceGrid empty_grid(const Building& building, const BuildingFace& face) {
  FaceGrid grid;
  const auto corners = places(building, face.outline);
  Eigen::Vector3d normal = area_vector(corners);
  if (!(normal.norm() > 1e-9)) return grid;
  normal.normalize();
  grid.frame = upright_frame({normal, -normal.dot(corners[0])}, corners[0]);
  Rings rings{flat(grid.frame, corners)};
  for (const auto& hole : face.holes) rings.push_back(flat(grid.frame, places(building, hole)));
  for (const auto& p : rings[0]) grid.box.extend(p);
  const auto squares = [](double length) { return std::max(1, static_cast<int>(std::lround(length / square))); };
  grid.width = squares(grid.box.sizes().x());
  grid.height = squares(grid.box.sizes().y());
  grid.squares.assign(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height), FaceGrid::outside);
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x)
      if (inside_rings(rings, grid.centre(x, y))) grid.set(x, y, FaceGrid::unseen);
  return grid;
}

void cut_out(const std::vector<Eigen::Vector3d>& opening, FaceGrid& grid) {
  if (opening.size() < 3 || grid.squares.empty()) return;
  const Rings rings{flat(grid.frame, opening)};
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x)
      if (inside_rings(rings, grid.centre(x, y))) grid.set(x, y, FaceGrid::outside);
}

struct Primitive {
  const PlanePrimitive* plane;
  Eigen::AlignedBox3d box;
};

std::vector<Primitive> with_boxes(const PlanePrimitives& planes, const Context& context) {
  std::vector<Primitive> result(planes.primitives.size());
  context.parallel_for(result.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      result[i].plane = &planes.primitives[i];
      for (const auto p : planes.primitives[i].inliers) result[i].box.extend(planes.cloud->points[p].cast<double>());
    }
  });
  return result;
}

void mark_seen(const std::vector<Primitive>& primitives, const Cloud& cloud, FaceGrid& grid) {
  const Eigen::Vector3d normal = grid.frame.u.cross(grid.frame.v);
  const double near = std::abs(normal.z()) < 0.5 ? on_wall : on_level;
  Eigen::AlignedBox3d around;
  for (const double x : {grid.box.min().x(), grid.box.max().x()})
    for (const double y : {grid.box.min().y(), grid.box.max().y()})
      for (const double off : {-near, near}) around.extend(grid.frame.to_space({x, y}) + off * normal);
  for (const auto& primitive : primitives) {
    if (primitive.plane->plane.normal.dot(normal) < same_way || !primitive.box.intersects(around)) continue;
    for (const auto i : primitive.plane->inliers) {
      const Eigen::Vector3d p = cloud.points[i].cast<double>();
      if (std::abs(normal.dot(p - grid.frame.origin)) > near) continue;
      const Eigen::Vector2d place = grid.frame.to_plane(p);
      const int x = grid.column(place.x()), y = grid.row(place.y());
      if (grid.at(x, y) == FaceGrid::unseen) grid.set(x, y, FaceGrid::seen);
    }
  }
}

/// A square whose neighbours were mostly seen lies between points that are further apart than it is wide.
void close_gaps(FaceGrid& grid) {
  const FaceGrid before = grid;
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x) {
      if (before.at(x, y) != FaceGrid::unseen) continue;
      int around = 0, seen = 0;
      for (int v = y - 1; v <= y + 1; ++v)
        for (int u = x - 1; u <= x + 1; ++u) {
          if (u == x && v == y) continue;
          around += before.at(u, v) != FaceGrid::outside ? 1 : 0;
          seen += before.at(u, v) == FaceGrid::seen ? 1 : 0;
        }
      if (around > 0 && 5 * seen >= 3 * around) grid.set(x, y, FaceGrid::seen);
    }
}

}  // namespace

bool inside_rings(const Rings& rings, const Eigen::Vector2d& p) {
  bool result = false;
  for (const auto& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d &a = ring[i], &b = ring[(i + 1) % ring.size()];
      if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()))
        result = !result;
    }
  return result;
}

std::size_t FaceGrid::count(Square what) const {
  return static_cast<std::size_t>(std::count(squares.begin(), squares.end(), what));
}

std::optional<double> FaceGrid::height_over(const Eigen::Vector2d& place) const {
  const Eigen::Vector3d normal = frame.u.cross(frame.v);
  if (squares.empty() || std::abs(normal.z()) < 0.1) return {};
  const double z = frame.origin.z() - normal.head<2>().dot(place - frame.origin.head<2>()) / normal.z();
  if (at(frame.to_plane({place.x(), place.y(), z})) == outside) return {};
  return z;
}

std::vector<FaceGrid> face_grids(const Building& building, const PlanePrimitives& planes, const Context& context) {
  std::vector<std::vector<const std::vector<Eigen::Vector3d>*>> openings(building.faces.size());
  for (const auto& opening : building.openings) {
    if (opening.face_a >= 0) openings[static_cast<std::size_t>(opening.face_a)].push_back(&opening.outline_a);
    if (opening.face_b >= 0) openings[static_cast<std::size_t>(opening.face_b)].push_back(&opening.outline_b);
  }
  const auto primitives = with_boxes(planes, context);
  std::vector<FaceGrid> grids(building.faces.size());
  context.parallel_for(
      grids.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
          grids[f] = empty_grid(building, building.faces[f]);
          if (grids[f].squares.empty()) continue;
          for (const auto* opening : openings[f]) cut_out(*opening, grids[f]);
          mark_seen(primitives, *planes.cloud, grids[f]);
          close_gaps(grids[f]);
        }
      },
      1);
  return grids;
}

double distance_to_rings(const Rings& rings, const Eigen::Vector2d& p) {
  double nearest = 1e300;
  for (const auto& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d &a = ring[i], d = ring[(i + 1) % ring.size()] - a;
      const double along = d.squaredNorm() > 0 ? std::clamp(d.dot(p - a) / d.squaredNorm(), 0.0, 1.0) : 0;
      nearest = std::min(nearest, (a + along * d - p).norm());
    }
  return nearest;
}

}  // namespace atrium::layout
