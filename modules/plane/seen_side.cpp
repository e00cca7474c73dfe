#include "modules/plane/seen_side.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "modules/geometry/grid_walk.hpp"
#include "modules/types/turn_between.hpp"

namespace atrium::plane {
namespace {

constexpr double least_cell = 0.05;      // metres
constexpr double furthest = 20;          // metres: a ray that meets nothing so far counts as one that leaves the scene
constexpr double free_enough = 3;        // metres: a longer way is no freer
constexpr std::size_t most_places = 64;  // of a plane, that cast rays
constexpr double undecided = 0.1;        // a smaller share of difference between the sides says nothing
constexpr double edge_on = 0.1;          // metres: a position so near to a plane does not tell its sides
constexpr double clear = 0.2;            // a larger one needs no look at the rim
constexpr double nothing = 0.1;          // of the rim, where a side meets nothing
constexpr double least_visible = 0.25;   // of a plane's places, for one position to speak for it
constexpr double rim_distance = 0.2;     // metres from the plane: wider than a partition, narrower than a corridor
constexpr double rim_tolerance = 0.25;   // metres

/// Directions about +z: straight, and six each at 45° and 70° from it.
std::vector<Eigen::Vector3d> directions_about_z() {
  std::vector<Eigen::Vector3d> directions{Eigen::Vector3d::UnitZ()};
  for (const double tilt : {45.0, 70.0})
    for (int k = 0; k < 6; ++k) {
      const double t = tilt * std::numbers::pi / 180, a = (k + tilt / 90) * std::numbers::pi / 3;
      directions.emplace_back(std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), std::cos(t));
    }
  return directions;
}

class SeenFrom {
 public:
  SeenFrom(const Cloud& cloud, const Context& context) : cloud_(cloud), directions_(directions_about_z()) {
    const bool every_point_names_its_position = !cloud.sensors.empty() && !cloud.source.empty();
    if (!every_point_names_its_position) grid_ = grid_for_rays(cloud.points, least_cell, context);
  }

  /// Above 0: more of the plane's points were seen from its positive side. 0: no position saw it.
  double by_positions(const PlanePrimitive& primitive) const {
    if (cloud_.sensors.empty()) return 0;
    const bool one_for_all = cloud_.source.empty();
    const auto places = places_of(primitive);
    double vote = 0;
    std::size_t visible = 0;
    for (const auto i : places) {
      const std::size_t s = one_for_all ? 0 : cloud_.source[i];
      if (s >= cloud_.sensors.size()) continue;
      const Eigen::Vector3d sensor = cloud_.sensors[s].cast<double>();
      const double distance = primitive.plane.signed_distance(sensor);
      if (std::abs(distance) < edge_on) continue;
      const double side = distance > 0 ? 1 : -1;
      if (one_for_all && !is_free(primitive, i, side, sensor)) continue;
      ++visible;
      vote += side;
    }
    return static_cast<double>(visible) < least_visible * static_cast<double>(places.size()) ? 0 : vote;
  }

  /// The free space before the plane less that behind it, as a share of both: −1 to 1. A quarter of the places decides
  /// where the share is clear.
  double by_free_space(const PlanePrimitive& primitive) const {
    if (grid_ == nullptr) return 0;
    constexpr double certain = 0.4;
    constexpr std::size_t parts = 4;
    const Eigen::Quaterniond turn = turn_between(Eigen::Vector3d::UnitZ(), primitive.plane.normal);
    const std::vector<std::uint32_t> places = places_of(primitive);
    double before = 0, behind = 0, share = 0;
    for (std::size_t part = 0; part < parts && std::abs(share) < certain; ++part) {
      for (std::size_t k = part; k < places.size(); k += parts) {
        const Eigen::Vector3d from = foot(primitive, places[k]);
        for (const Eigen::Vector3d& d : directions_) {
          const Eigen::Vector3d direction = turn * d;
          before += way(primitive, from, direction, 1);
          behind += way(primitive, from, -direction, -1);
        }
      }
      share = before + behind > 0 ? (before - behind) / (before + behind) : 0;
    }
    return share;
  }

  /// How much of the surface's rim meets something before it less how much does behind it, −1 to 1; 0 if both sides do.
  /// Where a wall's points end there is a floor, a ceiling, another wall or what hides the wall: on the side of the
  /// room. In a cavity between two rooms, or outside, there is nothing. (Inside of a thing that stands in a room there
  /// may be more than before it, but before it there is the floor.)
  double by_rim(const PlanePrimitive& primitive) const {
    if (grid_ == nullptr) return 0;
    constexpr int directions = 8;
    const Eigen::Quaterniond turn = turn_between(Eigen::Vector3d::UnitZ(), primitive.plane.normal);
    std::array<std::size_t, 2> met{};
    std::size_t asked = 0;
    for (const auto i : places_of(primitive))
      for (int k = 0; k < directions; ++k) {
        const double a = 2 * std::numbers::pi * k / directions;
        const Eigen::Vector3d direction = turn * Eigen::Vector3d(std::cos(a), std::sin(a), 0);
        const Eigen::Vector3d from = foot(primitive, i);
        const double end = end_of_surface(primitive, from, direction);
        if (end <= 0) continue;
        ++asked;
        for (const int side : {0, 1})
          if (meets(primitive, from, direction, end, side == 0 ? 1 : -1)) ++met.at(static_cast<std::size_t>(side));
      }
    const double all = static_cast<double>(std::max<std::size_t>(asked, 1));
    const double before = static_cast<double>(met[0]) / all, behind = static_cast<double>(met[1]) / all;
    return std::min(before, behind) < nothing ? before - behind : 0;
  }

  /// Whether the side is the inside of a wall or a slab: straight on a surface stands nearer than walls are thick, and
  /// on the other side there is nothing.
  bool is_solid(const PlanePrimitive& primitive, double side) const {
    if (grid_ == nullptr) return false;
    constexpr double thinnest = 0.12, thickest = 0.65;  // metres, of what has an outside
    constexpr double many = 0.5, most = 0.8;  // of the places; behind the rest are reveals and the ends of slabs
    const Eigen::Quaterniond turn = turn_between(Eigen::Vector3d::UnitZ(), primitive.plane.normal);
    const std::vector<std::uint32_t> places = places_of(primitive);
    std::size_t near = 0, open = 0;
    for (const auto i : places) {
      const Eigen::Vector3d from = foot(primitive, i);
      const double thickness = way(primitive, from, side * primitive.plane.normal, side);
      near += thickness > thinnest && thickness < thickest ? 1 : 0;
      open += std::all_of(directions_.begin(), directions_.end(),
                          [&](const Eigen::Vector3d& d) { return way(primitive, from, turn * d * -side, -side) == 0; });
    }
    const auto all = static_cast<double>(places.size());
    return static_cast<double>(near) >= many * all && static_cast<double>(open) >= most * all;
  }

  double by_normals(const PlanePrimitive& primitive) const {
    if (!cloud_.has_normals()) return 0;
    double vote = 0;
    for (const auto i : primitive.inliers) vote += primitive.plane.normal.dot(cloud_.normals[i].cast<double>());
    return vote;
  }

 private:
  static std::vector<std::uint32_t> places_of(const PlanePrimitive& primitive) {
    std::vector<std::uint32_t> places;
    const std::size_t step = std::max<std::size_t>(1, primitive.inliers.size() / most_places);
    for (std::size_t k = step / 2; k < primitive.inliers.size(); k += step) places.push_back(primitive.inliers[k]);
    return places;
  }
  Eigen::Vector3d foot(const PlanePrimitive& primitive, std::uint32_t i) const {
    const Eigen::Vector3d p = cloud_.points[i].cast<double>();
    return p - primitive.plane.signed_distance(p) * primitive.plane.normal;
  }
  /// Whether the cell holds a point on this side of the plane that is not of the plane's own surface.
  bool blocks(const PlanePrimitive& primitive, std::uint32_t cell, double side) const {
    constexpr double least_off = 0.02;  // metres
    const auto near = static_cast<float>(std::max(least_off, 3 * primitive.residual));
    const Eigen::Vector3f normal = (side * primitive.plane.normal).cast<float>();
    const auto offset = static_cast<float>(side * primitive.plane.offset);
    const PointGrid::Cell& c = grid_->cells()[cell];
    for (std::uint32_t k = c.begin; k < c.end; ++k)
      if (normal.dot(grid_->points()[k]) + offset > near) return true;
    return false;
  }
  /// How far the plane's own points go on in a direction; 0: further than a free way is looked at.
  double end_of_surface(const PlanePrimitive& primitive, const Eigen::Vector3d& from,
                        const Eigen::Vector3d& direction) const {
    constexpr double gap = 0.3;  // metres: no points for so long is an end
    const double near = std::max(0.02, 3 * primitive.residual);
    double end = 0;
    const bool stopped = walk(*grid_, from, direction, furthest, [&](std::uint32_t cell, double at) {
      if (at > end + gap) return true;
      const PointGrid::Cell& c = grid_->cells()[cell];
      for (std::uint32_t k = c.begin; k < c.end; ++k)
        if (std::abs(primitive.plane.signed_distance(grid_->points()[k].cast<double>())) <= near) {
          end = at;
          break;
        }
      return false;
    });
    return stopped || end + gap < furthest ? end : 0;
  }
  /// Whether something stands at the end of the surface on that side, and nothing before it.
  bool meets(const PlanePrimitive& primitive, const Eigen::Vector3d& from, const Eigen::Vector3d& direction, double end,
             double side) const {
    double at = 0;
    const Eigen::Vector3d beside = from + side * rim_distance * primitive.plane.normal;
    const bool met = walk(*grid_, beside, direction, end + rim_tolerance, [&](std::uint32_t cell, double distance) {
      at = distance;
      return grid_->cells()[cell].end > grid_->cells()[cell].begin;
    });
    return met && at >= end - rim_tolerance;
  }
  double way(const PlanePrimitive& primitive, const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
             double side) const {
    double length = 0;
    const bool met = walk(*grid_, from, direction, furthest, [&](std::uint32_t cell, double at) {
      length = at;
      return blocks(primitive, cell, side);
    });
    return met ? std::min(length, free_enough) : 0;
  }
  bool is_free(const PlanePrimitive& primitive, std::uint32_t i, double side, const Eigen::Vector3d& sensor) const {
    const Eigen::Vector3d from = foot(primitive, i);
    const double distance = (sensor - from).norm();
    if (distance < 2 * grid_->cell_size()) return true;
    return !walk(*grid_, from, (sensor - from) / distance, distance - grid_->cell_size(),
                 [&](std::uint32_t cell, double) { return blocks(primitive, cell, side); });
  }

  const Cloud& cloud_;
  std::unique_ptr<PointGrid> grid_;  ///< none where positions decide without it
  std::vector<Eigen::Vector3d> directions_;
};

enum class Evidence : std::uint8_t { none, positions, free_space, normals };

struct Side {
  double sign = 1;
  Evidence by = Evidence::none;
  bool against_normals = false;
};

Side side_of(const PlanePrimitive& primitive, const SeenFrom& seen) {
  Side side;
  const double normals = seen.by_normals(primitive);
  double vote = seen.by_positions(primitive);
  side.by = Evidence::positions;
  if (vote == 0) {
    vote = seen.by_free_space(primitive);
    if (std::abs(vote) < clear) vote += seen.by_rim(primitive);
    // Normals that look the same way speak against a wall's inside.
    if (std::abs(vote) >= undecided && normals * vote <= 0 && seen.is_solid(primitive, vote < 0 ? -1 : 1)) vote = -vote;
    side.by = Evidence::free_space;
    if (std::abs(vote) < undecided && normals != 0) {
      vote = normals;
      side.by = Evidence::normals;
    }
  }
  side.sign = vote < 0 ? -1 : 1;
  side.against_normals = normals * side.sign < 0;
  return side;
}

}  // namespace

SeenSides turn_to_seen_sides(PlanePrimitives& planes, const Context& context) {
  SeenSides result;
  if (planes.primitives.empty()) return result;
  const SeenFrom seen(*planes.cloud, context);
  std::vector<Side> sides(planes.primitives.size());
  context.parallel_chunks(sides.size(), 1, [&](std::size_t i, std::size_t, std::size_t) {
    if (!planes.primitives[i].inliers.empty()) sides[i] = side_of(planes.primitives[i], seen);
  });
  for (std::size_t i = 0; i < sides.size(); ++i) {
    Plane& plane = planes.primitives[i].plane;
    if (sides[i].sign < 0) plane = {-plane.normal, -plane.offset};
    result.by_positions += sides[i].by == Evidence::positions ? 1 : 0;
    result.by_free_space += sides[i].by == Evidence::free_space ? 1 : 0;
    result.by_normals += sides[i].by == Evidence::normals ? 1 : 0;
    result.turned_against_normals += sides[i].against_normals ? 1 : 0;
  }
  return result;
}

}  // namespace atrium::plane
