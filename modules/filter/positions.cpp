#include "modules/filter/positions.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "graph/api/text.hpp"
#include "modules/geometry/grid_walk.hpp"

namespace atrium::filter {
namespace {

constexpr double least_cell = 0.05;    // metres
constexpr double straight_part = 0.8;  // of a way: the rest may graze the surface it ends on
constexpr std::size_t most_ways = 20000;

/// The points in cubes. What hides other things fills its cubes as surfaces do; strays do not.
class Ways {
 public:
  Ways(const Cloud& cloud, const Context& context) : grid_(grid_for_rays(cloud.points, least_cell, context)) {
    constexpr double part = 0.2;  // of what the cube of the median point holds
    std::vector<std::size_t> counts;
    counts.reserve(grid_->cells().size());
    for (const auto& cell : grid_->cells()) counts.push_back(cell.end - cell.begin);
    std::sort(counts.begin(), counts.end());
    std::size_t below = 0, i = 0;
    while (i + 1 < counts.size() && 2 * (below + counts[i]) < grid_->inside()) below += counts[i++];
    if (!counts.empty()) least_ = part * static_cast<double>(counts[i]);
  }
  bool are_free(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
    const double length = (to - from).norm();
    if (length < 2 * grid_->cell_size()) return true;
    return !walk(*grid_, from, (to - from) / length, straight_part * length, [&](std::uint32_t c, double) {
      const auto& cell = grid_->cells()[c];
      return static_cast<double>(cell.end - cell.begin) >= least_;
    });
  }

 private:
  std::unique_ptr<PointGrid> grid_;
  double least_ = 0;  ///< points in a cube that stop a way
};

/// Share of a sample of the points that their own positions saw along a free way.
double free_share(const Cloud& cloud, const Ways& ways, const Context& context) {
  const std::size_t step = std::max<std::size_t>(1, cloud.size() / most_ways);
  const std::size_t count = cloud.size() / step;
  std::vector<std::uint8_t> free(count, 0);
  context.parallel_for(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t i = k * step;
      const std::size_t s = cloud.source[i];
      free[k] =
          s < cloud.sensors.size() && ways.are_free(cloud.sensors[s].cast<double>(), cloud.points[i].cast<double>());
    }
  });
  return count == 0 ? 0 : static_cast<double>(std::count(free.begin(), free.end(), 1)) / static_cast<double>(count);
}

/// The furthest point in each of the bins around a place: squares on the faces of a cube, 45 a side.
std::vector<std::uint32_t> furthest_in_bins(const Cloud& cloud, const Eigen::Vector3d& place) {
  constexpr int side = 45;
  constexpr std::uint32_t none = 0xffffffffU;
  std::vector<std::uint32_t> best(std::size_t{6} * side * side, none);
  std::vector<double> reach(best.size(), 0);
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d d = cloud.points[i].cast<double>() - place;
    Eigen::Index axis = 0;
    const double longest = d.cwiseAbs().maxCoeff(&axis);
    if (longest <= 0) continue;
    const auto bin_of = [&](double x) {
      return std::clamp(static_cast<int>((x / longest + 1) / 2 * side), 0, side - 1);
    };
    const auto face = static_cast<std::size_t>(2 * axis + (d[axis] > 0 ? 1 : 0));
    const std::size_t bin = (face * side + static_cast<std::size_t>(bin_of(d[(axis + 1) % 3]))) * side +
                            static_cast<std::size_t>(bin_of(d[(axis + 2) % 3]));
    if (d.norm() <= reach[bin]) continue;
    reach[bin] = d.norm();
    best[bin] = i;
  }
  std::erase(best, none);
  return best;
}

/// Share of the directions around a place, those that meet points, in which the furthest point is seen freely.
double visible_share(const Cloud& cloud, const Ways& ways, const Eigen::Vector3d& place, const Context& context) {
  const std::vector<std::uint32_t> targets = furthest_in_bins(cloud, place);
  std::vector<std::uint8_t> free(targets.size(), 0);
  context.parallel_for(targets.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) free[k] = ways.are_free(place, cloud.points[targets[k]].cast<double>());
  });
  return targets.empty()
             ? 0
             : static_cast<double>(std::count(free.begin(), free.end(), 1)) / static_cast<double>(targets.size());
}

/// Whether a place is amid the points and off all surfaces: headsets put the origin on the floor.
bool stands_clear(const Cloud& cloud, const Eigen::Vector3d& place) {
  constexpr double near = 0.3;          // metres
  constexpr double few_share = 0.0005;  // of the points: tripods and dust
  Eigen::AlignedBox3d box;
  std::size_t around = 0;
  for (const auto& p : cloud.points) {
    const Eigen::Vector3d q = p.cast<double>();
    box.extend(q);
    around += (q - place).squaredNorm() < near * near ? 1 : 0;
  }
  return box.contains(place) && static_cast<double>(around) <= few_share * static_cast<double>(cloud.size());
}

SharedOutput<Cloud> with_positions(const Input<Cloud>& cloud, std::vector<Eigen::Vector3f> sensors) {
  if (cloud->sensors == sensors && cloud->source.empty()) return cloud;
  auto result = std::make_shared<Cloud>(*cloud);
  result->sensors = std::move(sensors);
  result->source.clear();
  return result;
}

SharedOutput<Cloud> checked_positions(const Input<Cloud>& cloud, double min_free, const Context& context) {
  const double share = free_share(*cloud, Ways(*cloud, context), context);
  if (share >= min_free) {
    context.info(fmt::format("{}, {:.0f} % of the ways to their points are free",
                             counted(cloud->sensors.size(), "position"), 100 * share));
    return cloud;
  }
  context.warn(
      fmt::format("the scanner's positions are left out: only {:.0f} % of the ways from them to their points are free "
                  "of other points",
                  100 * share));
  return with_positions(cloud, {});
}

/// One position for all points: the file's own, or its origin.
SharedOutput<Cloud> checked_position(const Input<Cloud>& cloud, double min_visible, const Context& context) {
  const bool named = cloud->sensors.size() == 1;
  const Eigen::Vector3d place = named ? cloud->sensors.front().cast<double>() : Eigen::Vector3d(-cloud->origin);
  if (!named && !stands_clear(*cloud, place)) return with_positions(cloud, {});
  const double share = visible_share(*cloud, Ways(*cloud, context), place, context);
  if (share >= min_visible) {
    context.info(fmt::format("one position, {}: {:.0f} % of the directions around it show one depth",
                             named ? "the file's" : "the file's origin", 100 * share));
    return with_positions(cloud, {place.cast<float>()});
  }
  if (named)
    context.warn(
        fmt::format("the scanner's position is left out: only {:.0f} % of the directions around it show one "
                    "depth, so the points were taken from several places",
                    100 * share));
  else
    context.info(fmt::format("no position is known; {:.0f} % of the directions around the file's origin show one depth",
                             100 * share));
  return with_positions(cloud, {});
}

}  // namespace

Positions::Out Positions::run(const In& in, const Params& params, Context& context) {
  const Cloud& cloud = *in.cloud;
  if (cloud.size() == 0) return {in.cloud};
  if (!cloud.sensors.empty() && !cloud.source.empty()) return {checked_positions(in.cloud, params.min_free, context)};
  return {checked_position(in.cloud, params.min_visible, context)};
}

}  // namespace atrium::filter
