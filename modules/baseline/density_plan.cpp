#include "modules/baseline/density_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "graph/api/error.hpp"
#include "modules/baseline/plan_image.hpp"
#include "modules/baseline/ring_outline.hpp"

namespace atrium::baseline {
namespace {

constexpr float level = 0.8F;     // |nz| of floors and ceilings, at least
constexpr float sideways = 0.3F;  // |nz| of walls, at most
constexpr double near_height = 0.05;
constexpr double ceiling_band = 0.1;
constexpr double wall_band = 0.2;  // from floor and ceiling: what lies there belongs to them
constexpr double cell_height = 0.2;
constexpr double most_pixels = 1e8;

bool is_level(const Cloud& cloud, std::size_t i) {
  return !cloud.has_normals() || std::abs(cloud.normals[i].z()) >= level;
}
bool is_sideways(const Cloud& cloud, std::size_t i) {
  return !cloud.has_normals() || std::abs(cloud.normals[i].z()) <= sideways;
}

double median_near(std::vector<double> heights, double height) {
  std::erase_if(heights, [&](double z) { return std::abs(z - height) > near_height; });
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  return *middle;
}

PlanImage empty_image(const Cloud& cloud, double pixel) {
  Eigen::Vector2d low = cloud.points.front().head<2>().cast<double>(), high = low;
  for (const auto& p : cloud.points) {
    low = low.cwiseMin(p.head<2>().cast<double>());
    high = high.cwiseMax(p.head<2>().cast<double>());
  }
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
    if (is_level(cloud, i) && std::abs(cloud.points[i].z() - heights.ceiling) <= ceiling_band)
      pixel_of(image, cloud.points[i]) = 1;
  return image;
}

// 1 where points cover the share min_coverage of the height between the bands.
PlanImage wall_image(const Cloud& cloud, const StoreyHeights& heights, const PlanImage& empty, double min_coverage) {
  const double low = heights.floor + wall_band, high = heights.ceiling - wall_band;
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

// Each room's squares have its number; the borders of those that are large enough.
std::vector<PlanPolygon> room_borders(const PlanImage& inside, double min_area) {
  std::vector<std::size_t> sizes;
  const PlanImage rooms = components(inside, sizes);
  std::vector<PlanPolygon> borders;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    if (static_cast<double>(sizes[k]) * inside.pixel * inside.pixel < min_area) continue;
    PlanPolygon border = border_of(rooms, static_cast<std::int32_t>(k + 1));
    std::erase_if(border.holes, [&](const PlanRing& hole) { return PlanPolygon{hole, {}}.area() > -min_area; });
    borders.push_back(std::move(border));
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

StoreyHeights storey_heights(const Cloud& cloud, double percentile) {
  std::vector<double> heights;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (is_level(cloud, i)) heights.push_back(cloud.points[i].z());
  constexpr std::size_t least = 100;
  if (heights.size() < least)
    throw Error(fmt::format("{} points of floor and ceiling are too few for their heights", heights.size()),
                "a cloud with z up is needed, of a whole storey");
  std::sort(heights.begin(), heights.end());
  const auto rank = static_cast<std::size_t>(percentile * static_cast<double>(heights.size() - 1));
  StoreyHeights result{median_near(heights, heights[rank]), median_near(heights, heights[heights.size() - 1 - rank])};
  if (result.ceiling - result.floor < 1)
    throw Error(fmt::format("floor and ceiling are {:.2f} m apart", result.ceiling - result.floor),
                "a cloud with z up is needed, of a whole storey");
  return result;
}

std::vector<PlanRoom> density_rooms(const Cloud& cloud, const StoreyHeights& heights, const DensityLimits& limits,
                                    const Context& context) {
  const PlanImage empty = empty_image(cloud, limits.pixel);
  const int closing = static_cast<int>(std::lround(limits.closing / limits.pixel));
  PlanImage inside = eroded(dilated(ceiling_image(cloud, heights, empty), closing), closing);
  context.check_cancelled();
  inside = dilated(eroded(inside, closing), closing);  // outliers go
  const PlanImage walls = wall_image(cloud, heights, empty, limits.min_coverage);
  for (std::size_t i = 0; i < inside.values.size(); ++i)
    if (walls.values[i] != 0) inside.values[i] = 0;
  context.check_cancelled();

  const auto borders = room_borders(inside, limits.min_room_area);
  const WallPoints points = wall_points(cloud, heights);
  const double direction = refined_direction(direction_of(borders, limits.tolerance), points);
  const OutlineLimits outline{limits.tolerance, limits.snap_angle, limits.reach};
  std::vector<PlanRoom> rooms(borders.size());
  context.parallel_for(
      borders.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
          rooms[k].height = heights.ceiling - heights.floor;
          rooms[k].polygon.outline = straight_outline(borders[k].outline, direction, points, outline);
          for (const auto& hole : borders[k].holes)
            rooms[k].polygon.holes.push_back(straight_outline(hole, direction, points, outline));
        }
      },
      1);
  return rooms;
}

}  // namespace atrium::baseline
