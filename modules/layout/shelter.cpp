#include "modules/layout/shelter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace atrium::layout {
namespace {

constexpr int most_places = 64;  // of a floor
constexpr int shelter_directions = 16;
constexpr double chest = 1.2;            // metres over the floor: most walls are seen there
constexpr double least_wall_area = 0.5;  // m²: smaller upright planes enclose nothing

double height_at(const Plane& plane, const Eigen::Vector2d& p) {
  return -(plane.normal.x() * p.x() + plane.normal.y() * p.y() + plane.offset) / plane.normal.z();
}

/// Squares of a raster that hold points, evenly chosen.
std::vector<Eigen::Vector2d> places_of(const Raster& raster, int most) {
  std::vector<Eigen::Vector2d> all, result;
  for (int y = 0; y < raster.height; ++y)
    for (int x = 0; x < raster.width; ++x)
      if (raster.at(x, y)) all.push_back(raster.centre(x, y));
  const std::size_t step = std::max<std::size_t>(1, all.size() / static_cast<std::size_t>(most));
  for (std::size_t i = step / 2; i < all.size(); i += step) result.push_back(all[i]);
  return result;
}

/// For each square the number of the connected piece that it is of; −1: it holds no points.
std::vector<int> pieces_of(const Raster& raster) {
  std::vector<int> pieces(raster.bits.size(), -1);
  int count = 0;
  std::vector<std::pair<int, int>> open;
  for (int y0 = 0; y0 < raster.height; ++y0)
    for (int x0 = 0; x0 < raster.width; ++x0) {
      open = {{x0, y0}};
      bool any = false;
      while (!open.empty()) {
        const auto [x, y] = open.back();
        open.pop_back();
        if (!raster.at(x, y)) continue;
        int& piece =
            pieces[static_cast<std::size_t>(y) * static_cast<std::size_t>(raster.width) + static_cast<std::size_t>(x)];
        if (piece >= 0) continue;
        piece = count;
        any = true;
        for (const auto& [u, v] : {std::pair{x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}}) open.emplace_back(u, v);
      }
      count += any ? 1 : 0;
    }
  return pieces;
}

}  // namespace

Shelter::Shelter(const PlanePrimitives& planes, const std::vector<Footprint>& footprints, double min_clearance)
    : planes_(planes), footprints_(footprints), min_clearance_(min_clearance) {
  for (std::size_t i = 0; i < footprints.size(); ++i) {
    const Footprint& f = footprints[i];
    const Plane& plane = planes.primitives[i].plane;
    if (f.raster.empty()) continue;
    if (!f.upright) {
      if (plane.normal.z() < 0) down_.push_back(i);
      continue;
    }
    if (f.raster.area() < least_wall_area) continue;
    const double flat = plane.normal.head<2>().norm();
    const double middle = (f.raster.low.y() + f.raster.high().y()) / 2;
    const Eigen::Vector2d normal = plane.normal.head<2>() / flat;
    const Eigen::Vector2d foot = -(plane.offset + plane.normal.z() * middle) / flat * normal;
    walls_.push_back({foot + f.raster.low.x() * f.along, foot + f.raster.high().x() * f.along, normal, f.raster.low.y(),
                      f.raster.high().y()});
  }
}

double Shelter::covered(std::size_t floor) const {
  const auto places = places_of(footprints_[floor].raster, 40 * most_places);
  if (places.empty()) return 0;
  const Plane& plane = planes_.primitives[floor].plane;
  const auto under = [&](const Eigen::Vector2d& p) {
    return std::any_of(down_.begin(), down_.end(), [&](std::size_t d) {
      return footprints_[d].raster.at(p) &&
             height_at(planes_.primitives[d].plane, p) - height_at(plane, p) >= min_clearance_;
    });
  };
  return static_cast<double>(std::count_if(places.begin(), places.end(), under)) / static_cast<double>(places.size());
}

double Shelter::under_low_ceiling(std::size_t floor) const {
  constexpr double least_ceiling = 2, over = 0.3;  // m², which undersides of cupboards do not have; metres
  const auto places = places_of(footprints_[floor].raster, 40 * most_places);
  if (places.empty()) return 0;
  const Plane& plane = planes_.primitives[floor].plane;
  std::vector<std::size_t> ceilings;
  for (const auto d : down_)
    if (footprints_[d].raster.area() >= least_ceiling) ceilings.push_back(d);
  const auto is_low = [&](const Eigen::Vector2d& p) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const auto d : ceilings)
      if (footprints_[d].raster.at(p))
        if (const double z = height_at(planes_.primitives[d].plane, p) - height_at(plane, p); z > over)
          lowest = std::min(lowest, z);
    return lowest < min_clearance_;
  };
  return static_cast<double>(std::count_if(places.begin(), places.end(), is_low)) / static_cast<double>(places.size());
}

bool Shelter::faces(const Eigen::Vector2d& from, const Eigen::Vector2d& direction, double height) const {
  double nearest = std::numeric_limits<double>::infinity();
  bool towards = false;
  for (const Wall& wall : walls_) {
    if (height < wall.low || height > wall.high) continue;
    const Eigen::Vector2d along = wall.b - wall.a, way = wall.a - from;
    const double cross = direction.x() * along.y() - direction.y() * along.x();
    if (std::abs(cross) < 1e-9) continue;
    const double length = (way.x() * along.y() - way.y() * along.x()) / cross;
    const double share = (way.x() * direction.y() - way.y() * direction.x()) / cross;
    if (length <= 0 || share < 0 || share > 1 || length >= nearest) continue;
    nearest = length;
    towards = wall.normal.dot(direction) < 0;
  }
  return towards;
}

double Shelter::enclosed(std::size_t floor) const {
  const auto places = places_of(footprints_[floor].raster, most_places);
  if (places.empty()) return 0;
  std::size_t facing = 0;
  for (const auto& p : places)
    for (int k = 0; k < shelter_directions; ++k) {
      const double angle = (k + 0.5) * 2 * std::numbers::pi / shelter_directions;
      facing += faces(p, {std::cos(angle), std::sin(angle)}, height_at(planes_.primitives[floor].plane, p) + chest);
    }
  return static_cast<double>(facing) / static_cast<double>(shelter_directions * static_cast<int>(places.size()));
}

/// Whether a wall that stands on this height looks towards p and is near it.
bool Shelter::at_wall(const Eigen::Vector2d& p, double height, double pixel) const {
  constexpr double near = 0.15, least_rise = 1, highest_foot = 0.4;  // metres
  return std::any_of(walls_.begin(), walls_.end(), [&](const Wall& wall) {
    if (wall.low > height + highest_foot || wall.high < height + least_rise) return false;
    const Eigen::Vector2d along = (wall.b - wall.a).normalized(), way = p - wall.a;
    const double off = wall.normal.dot(way), place = along.dot(way);
    return off > -near && off < near + pixel && place > -near && place < (wall.b - wall.a).norm() + near;
  });
}

bool Shelter::raised(std::size_t floor) const {
  constexpr double
      least_walled = 0.7,
      all_walled = 0.82;  // of the rim: a bed in a corner has half, in an alcove 0.75, a small room with a door 0.87
  constexpr double most_low = 0.7;  // of it under which one cannot stand: a worktop
  const Piece piece = largest_piece(floor);
  return piece.area >= least_raised && piece.walled >= (piece.area < large_raised ? all_walled : least_walled) &&
         under_low_ceiling(floor) <= most_low;
}

Shelter::Piece Shelter::largest_piece(std::size_t floor) const {
  constexpr int gap = 3;  // squares: single gaps within are none
  const Raster raster = footprints_[floor].raster.coarse(gap);
  const std::vector<int> pieces = pieces_of(raster);
  std::map<int, std::size_t> sizes;
  for (const int piece : pieces)
    if (piece >= 0) ++sizes[piece];
  if (sizes.empty()) return {};
  const auto largest =
      std::max_element(sizes.begin(), sizes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  std::size_t rim = 0, at_walls = 0;
  for (int y = 0; y < raster.height; ++y)
    for (int x = 0; x < raster.width; ++x) {
      if (pieces[static_cast<std::size_t>(y) * static_cast<std::size_t>(raster.width) + static_cast<std::size_t>(x)] !=
          largest->first)
        continue;
      if (raster.at(x - 1, y) && raster.at(x + 1, y) && raster.at(x, y - 1) && raster.at(x, y + 1)) continue;
      const Eigen::Vector2d p = raster.centre(x, y);
      ++rim;
      at_walls += at_wall(p, height_at(planes_.primitives[floor].plane, p), raster.pixel) ? 1 : 0;
    }
  return {static_cast<double>(largest->second) * raster.pixel * raster.pixel,
          rim == 0 ? 0 : static_cast<double>(at_walls) / static_cast<double>(rim)};
}

}  // namespace atrium::layout
