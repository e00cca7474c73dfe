#include "modules/baseline/density_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "graph/api/error.hpp"
#include "modules/baseline/plan_image.hpp"
#include "modules/baseline/ring_outline.hpp"
#include "modules/geometry/quantile.hpp"

namespace atrium::baseline {
namespace {

constexpr float sideways = 0.3F;       // |nz| of walls, at most
constexpr double ceiling_from = 0.85;  // of the height: lower level surfaces are no ceiling
constexpr double lintel_from = 0.84;   // of the height: above doors, windows and wardrobes
constexpr double lintel_to = 0.96;
constexpr double wall_band = 0.2;  // from floor and ceiling: what lies there belongs to them
constexpr double cell_height = 0.08;
constexpr double most_pixels = 1e8;
constexpr int opening = 3;     // pixels
constexpr int spur_width = 3;  // pixels, half of it
constexpr double spur_length = 0.6;

bool is_sideways(const Cloud& cloud, std::size_t i) {
  return !cloud.has_normals() || std::abs(cloud.normals[i].z()) <= sideways;
}

bool is_ceiling(const Cloud& cloud, std::size_t i, const StoreyHeights& heights) {
  const double z = cloud.points[i].z() - heights.floor, height = heights.ceiling - heights.floor;
  return is_level(cloud, i) && z >= ceiling_from * height && z <= height + wall_band;
}

// With a margin that no point lies in.
PlanImage empty_image(const Cloud& cloud, double pixel, double margin) {
  Eigen::Vector2d low = cloud.points.front().head<2>().cast<double>(), high = low;
  for (const auto& p : cloud.points) {
    low = low.cwiseMin(p.head<2>().cast<double>());
    high = high.cwiseMax(p.head<2>().cast<double>());
  }
  low.array() -= margin;
  high.array() += margin;
  const Eigen::Vector2d size = ((high - low) / pixel).array().ceil() + 1;
  if (size.x() * size.y() > most_pixels)
    throw Error(fmt::format("a plan of {:.0f} × {:.0f} pixels is too large", size.x(), size.y()),
                "raise 'pixel', or drop outliers before");
  return {low, pixel, static_cast<int>(size.x()), static_cast<int>(size.y())};
}
std::int32_t& pixel_of(PlanImage& image, const Eigen::Vector3f& p) {
  const Eigen::Vector2d place = (p.head<2>().cast<double>() - image.low) / image.pixel;
  return image.at(static_cast<int>(place.x()), static_cast<int>(place.y()));
}

PlanImage ceiling_image(const Cloud& cloud, const StoreyHeights& heights, const PlanImage& empty) {
  PlanImage image = empty;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (is_ceiling(cloud, i, heights)) pixel_of(image, cloud.points[i]) = 1;
  return image;
}

// 1 where points cover the share min_coverage of the height between `low` and `high`.
PlanImage covered_image(const Cloud& cloud, double low, double high, const PlanImage& empty, double min_coverage) {
  const int cells = std::clamp(static_cast<int>((high - low) / cell_height), 1, 31);
  PlanImage image = empty;  // a bit per cell
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double z = cloud.points[i].z();
    if (!is_sideways(cloud, i) || z < low || z >= high) continue;
    const int cell = std::min(cells - 1, static_cast<int>((z - low) / (high - low) * cells));
    pixel_of(image, cloud.points[i]) |= static_cast<std::int32_t>(1U << static_cast<unsigned>(cell));
  }
  for (auto& v : image.values) v = __builtin_popcount(static_cast<unsigned>(v)) >= min_coverage * cells ? 1 : 0;
  return image;
}

// Walls reach the ceiling, wardrobes do not; a lintel ends a room too. A pixel to each side is theirs.
PlanImage wall_image(const Cloud& cloud, const StoreyHeights& heights, const PlanImage& empty, double min_coverage) {
  const double height = heights.ceiling - heights.floor;
  return dilated(covered_image(cloud, heights.floor + lintel_from * height, heights.floor + lintel_to * height, empty,
                               min_coverage),
                 1);
}

WallPoints wall_points(const Cloud& cloud, const StoreyHeights& heights) {
  WallPoints walls;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double z = cloud.points[i].z();
    if (!is_sideways(cloud, i) || z < heights.floor + wall_band || z > heights.ceiling - wall_band) continue;
    walls.places.emplace_back(cloud.points[i].head<2>().cast<double>());
    if (cloud.has_normals()) walls.normals.emplace_back(cloud.normals[i].head<2>().cast<double>().normalized());
  }
  return walls;
}

// The median height of the ceiling over each room, else that of the storey.
void set_heights(const Cloud& cloud, const StoreyHeights& heights, const PlanImage& rooms,
                 const std::vector<std::int32_t>& numbers, std::vector<PlanRoom>& result) {
  const std::int32_t most = *std::max_element(rooms.values.begin(), rooms.values.end());
  std::vector<std::vector<double>> found(static_cast<std::size_t>(most) + 1);
  PlanImage image = rooms;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (is_ceiling(cloud, i, heights))
      found[static_cast<std::size_t>(pixel_of(image, cloud.points[i]))].push_back(cloud.points[i].z());
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    auto& z = found[static_cast<std::size_t>(numbers[k])];
    result[k].height = (z.empty() ? heights.ceiling : median(std::move(z))) - heights.floor;
  }
}

// What stands out into the room from its border, thin and short, parts nothing: the side of a shelf, the leaf of a
// door.
void drop_spurs(PlanImage& rooms, std::int32_t number) {
  PlanImage closed = rooms;
  for (auto& v : closed.values) v = v == number ? 1 : 0;
  closed = eroded(dilated(closed, spur_width), spur_width);
  for (std::size_t i = 0; i < closed.values.size(); ++i)
    if (rooms.values[i] != 0) closed.values[i] = 0;
  std::vector<std::size_t> sizes;
  const PlanImage spurs = components(closed, sizes);
  const auto extents = extents_of(spurs, sizes.size());
  for (std::size_t i = 0; i < spurs.values.size(); ++i)
    if (const auto k = spurs.values[i]; k > 0 && extents[static_cast<std::size_t>(k - 1)] * rooms.pixel <= spur_length)
      rooms.values[i] = number;
}

// Each room's squares have its number; the borders of those that are large enough.
std::vector<PlanPolygon> room_borders(const PlanImage& inside, double min_area, PlanImage& rooms,
                                      std::vector<std::int32_t>& numbers) {
  std::vector<std::size_t> sizes;
  rooms = components(inside, sizes);
  std::vector<PlanPolygon> borders;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    if (static_cast<double>(sizes[k]) * inside.pixel * inside.pixel < min_area) continue;
    drop_spurs(rooms, static_cast<std::int32_t>(k + 1));
    PlanPolygon border = border_of(rooms, static_cast<std::int32_t>(k + 1));
    std::erase_if(border.holes, [&](const PlanRing& hole) { return PlanPolygon{hole, {}}.area() > -min_area; });
    borders.push_back(std::move(border));
    numbers.push_back(static_cast<std::int32_t>(k + 1));
  }
  return borders;
}

double direction_of(const std::vector<PlanPolygon>& borders, double tolerance) {
  std::vector<PlanRing> rings;
  for (const auto& border : borders) {
    PlanRing ring;
    for (const auto i : simplified(border.outline, tolerance)) ring.push_back(border.outline[i]);
    rings.push_back(std::move(ring));
  }
  return main_direction(rings);
}

}  // namespace

std::vector<PlanRoom> density_rooms(const Cloud& cloud, const StoreyHeights& heights, const DensityLimits& limits,
                                    const Context& context) {
  const PlanImage empty = empty_image(cloud, limits.pixel, limits.closing + limits.pixel);
  const int closing = static_cast<int>(std::lround(limits.closing / limits.pixel));
  PlanImage inside = eroded(dilated(ceiling_image(cloud, heights, empty), closing), closing);
  context.check_cancelled();
  const PlanImage walls = wall_image(cloud, heights, empty, limits.min_coverage);
  for (std::size_t i = 0; i < inside.values.size(); ++i)
    if (walls.values[i] != 0) inside.values[i] = 0;
  // What stands free in a room (columns, cupboards) before what is narrow: the gap between it and a wall is room.
  fill_holes(inside, static_cast<std::size_t>(limits.min_room_area / (limits.pixel * limits.pixel)));
  // Outliers and the insides of walls go; corners that squares cut off a turned plan come back.
  const PlanImage wide = dilated(eroded(inside, opening), 2 * opening);
  for (std::size_t i = 0; i < inside.values.size(); ++i) inside.values[i] &= wide.values[i];
  context.check_cancelled();

  PlanImage numbered;
  std::vector<std::int32_t> numbers;
  const auto borders = room_borders(inside, limits.min_room_area, numbered, numbers);
  const WallPoints points = wall_points(cloud, heights);
  const double direction = refined_direction(direction_of(borders, limits.tolerance), points);
  const OutlineLimits outline{limits.tolerance, limits.snap_angle, limits.reach};
  std::vector<PlanRoom> rooms(borders.size());
  context.parallel_for(
      borders.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
          rooms[k].polygon.outline = straight_outline(borders[k].outline, direction, points, outline);
          for (const auto& hole : borders[k].holes)
            rooms[k].polygon.holes.push_back(straight_outline(hole, direction, points, outline));
        }
      },
      1);
  set_heights(cloud, heights, numbered, numbers, rooms);
  return rooms;
}

}  // namespace atrium::baseline
