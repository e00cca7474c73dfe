#include "modules/layout/raster.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numbers>

#include "graph/api/error.hpp"

namespace atrium::layout {
namespace {

std::vector<Eigen::Vector2d> flattened(const PlanePrimitive& primitive, const Cloud& cloud, bool from_above,
                                       Footprint& out) {
  std::vector<Eigen::Vector2d> points;
  points.reserve(primitive.inliers.size());
  const Eigen::Vector3d& n = primitive.plane.normal;
  out.upright = !from_above && is_upright(primitive.plane);
  out.along = out.upright ? Eigen::Vector2d(-n.y(), n.x()).normalized() : Eigen::Vector2d::UnitX();
  for (const auto i : primitive.inliers) {
    const Eigen::Vector3d p = cloud.points[i].cast<double>();
    points.emplace_back(out.upright ? Eigen::Vector2d(out.along.dot(p.head<2>()), p.z())
                                    : Eigen::Vector2d(p.head<2>()));
  }
  return points;
}

/// How many times wider squares a surface fills: a scan can be sparser on the ceiling than elsewhere. 1: not even those
/// of four times, so that it is scattered points.
int times_until_filled(const Raster& raster) {
  constexpr double full = 0.6;
  constexpr int most = 4;
  constexpr double least = 0.5;  // m²: of less, most squares stand at the border
  if (raster.area() < least) return 1;
  int times = 1;
  for (double area = raster.area(); times < most && area > 0; ++times) {
    // Doubled squares hold a quarter as many of a full surface, and as many of single points.
    const double doubled = raster.coarse(2 * times).area();
    const double own = times == 1 ? area : raster.coarse(times).area();
    if (own >= full * doubled) return times;
  }
  return 1;
}

}  // namespace

double Raster::area() const { return static_cast<double>(std::count(bits.begin(), bits.end(), 1)) * pixel * pixel; }

Raster Raster::coarse(int times) const {
  Raster result;
  result.low = low;
  result.pixel = times * pixel;
  result.width = (width + times - 1) / times;
  result.height = (height + times - 1) / times;
  result.bits.assign(static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.height), 0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (at(x, y))
        result.bits[static_cast<std::size_t>(y / times) * static_cast<std::size_t>(result.width) +
                    static_cast<std::size_t>(x / times)] = 1;
  return result;
}

namespace {

/// How many squares hold points, of all below and to the left of each corner of the raster's squares.
std::vector<int> sums_of(const Raster& raster) {
  const auto columns = static_cast<std::size_t>(raster.width) + 1;
  std::vector<int> sums(columns * (static_cast<std::size_t>(raster.height) + 1), 0);
  for (int y = 0; y < raster.height; ++y)
    for (int x = 0; x < raster.width; ++x) {
      const std::size_t i = (static_cast<std::size_t>(y) + 1) * columns + static_cast<std::size_t>(x) + 1;
      sums[i] = (raster.at(x, y) ? 1 : 0) + sums[i - 1] + sums[i - columns] - sums[i - columns - 1];
    }
  return sums;
}

}  // namespace

bool Raster::is_wide(double patch, double full, double least) const {
  const int side = std::max(1, static_cast<int>(std::lround(patch / pixel)));
  if (side > width || side > height) return false;
  const auto columns = static_cast<std::size_t>(width) + 1;
  const auto back = static_cast<std::size_t>(side);
  const auto index = [&](int x, int y) { return static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x); };
  const std::vector<int> sums = sums_of(*this);
  std::vector<int> covers(sums.size(), 0);  // changes of how many full squares lie over a place
  for (int y = side; y <= height; ++y)
    for (int x = side; x <= width; ++x) {
      const std::size_t i = index(x, y);
      const int count = sums[i] - sums[i - back] - sums[i - back * columns] + sums[i - back * columns - back];
      if (count < full * side * side) continue;
      ++covers[i - back * columns - back];
      --covers[i - back * columns];
      --covers[i - back];
      ++covers[i];
    }
  int all = 0, wide = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t i = index(x, y);
      if (x > 0) covers[i] += covers[i - 1];
      if (y > 0) covers[i] += covers[i - columns];
      if (x > 0 && y > 0) covers[i] -= covers[i - columns - 1];
      if (!at(x, y)) continue;
      ++all;
      wide += covers[i] > 0 ? 1 : 0;
    }
  return wide > 0 && wide >= least * all;
}

Raster rasterize(const std::vector<Eigen::Vector2d>& points, double pixel) {
  Raster raster;
  raster.pixel = pixel;
  if (points.empty()) return raster;
  Eigen::AlignedBox2d box;
  for (const auto& p : points) box.extend(p);
  raster.low = (box.min() / pixel).array().floor() * pixel;
  constexpr double most_squares = 1 << 27;
  if ((box.sizes() / pixel + Eigen::Vector2d::Ones()).prod() > most_squares)
    throw Error(fmt::format("the points of one plane lie up to {:.0f} m apart, too far for squares of {:.0f} mm",
                            box.sizes().maxCoeff(), 1000 * pixel),
                "leave out what lies far from the building (filter.crop, filter.outliers), or take larger squares "
                "(`pixel`)");
  raster.width = raster.column(box.max().x()) + 1;
  raster.height = raster.row(box.max().y()) + 1;
  raster.bits.assign(static_cast<std::size_t>(raster.width) * static_cast<std::size_t>(raster.height), 0);
  for (const auto& p : points) {
    const int x = std::clamp(raster.column(p.x()), 0, raster.width - 1);
    const int y = std::clamp(raster.row(p.y()), 0, raster.height - 1);
    raster.bits[static_cast<std::size_t>(y) * static_cast<std::size_t>(raster.width) + static_cast<std::size_t>(x)] = 1;
  }
  return raster;
}

Footprint footprint(const PlanePrimitive& primitive, const Cloud& cloud, double pixel, bool from_above) {
  Footprint result;
  const std::vector<Eigen::Vector2d> points = flattened(primitive, cloud, from_above, result);
  result.raster = rasterize(points, pixel);
  result.spacing = pixel * times_until_filled(result.raster);
  if (!result.upright) return result;
  result.tops.assign(static_cast<std::size_t>(result.raster.width), std::numeric_limits<double>::lowest());
  for (const auto& p : points) {
    const int column = std::clamp(result.raster.column(p.x()), 0, result.raster.width - 1);
    double& top = result.tops[static_cast<std::size_t>(column)];
    top = std::max(top, p.y());
  }
  return result;
}

std::vector<Footprint> footprints(const PlanePrimitives& planes, double pixel, const Context& context) {
  std::vector<Footprint> result(planes.primitives.size());
  context.parallel_for(
      result.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) result[i] = footprint(planes.primitives[i], *planes.cloud, pixel);
      },
      1);
  return result;
}

double fitting_pixel(const PlanePrimitives& planes, double least, const Context& context) {
  constexpr double full = 0.7;
  constexpr int steps = 8;
  double best = least;
  double best_share = 0;
  for (double pixel = least; pixel < least * std::pow(std::numbers::sqrt2, steps); pixel *= std::numbers::sqrt2) {
    // A full surface has a quarter as many squares of twice the size; at its border it has more, ever more the larger
    // they are.
    double fine = 0;
    double coarse = 0;
    for (const auto& f : footprints(planes, pixel, context)) fine += f.raster.area();
    for (const auto& f : footprints(planes, 2 * pixel, context)) coarse += f.raster.area();
    const double share = coarse > 0 ? fine / coarse : 1;
    if (share > best_share) {
      best_share = share;
      best = pixel;
    }
    if (share >= full || share < best_share) break;
  }
  return best;
}

}  // namespace atrium::layout
