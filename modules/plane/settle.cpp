#include "modules/plane/settle.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace atrium::plane {
namespace {

/// The shortest interval of sorted values that holds half of them.
std::span<const double> shortest_half(std::span<const double> sorted) {
  const std::size_t half = sorted.size() / 2;
  std::size_t best = 0;
  for (std::size_t i = 0; i + half < sorted.size(); ++i)
    if (sorted[i + half] - sorted[i] < sorted[best + half] - sorted[best]) best = i;
  return sorted.subspan(best, half + 1);
}

/// The step of values that are rounded to few numbers; 0: they are not. `sorted`: without the far ones.
double step_of(std::span<const double> sorted) {
  constexpr std::size_t few = 20;
  std::size_t distinct = 1;
  constexpr double same = 1e-5;  // metres: of rounding
  for (std::size_t i = 1; i < sorted.size() && distinct <= few; ++i)
    distinct += sorted[i] - sorted[i - 1] > same ? 1 : 0;
  return distinct > few || distinct < 2 ? 0 : (sorted.back() - sorted.front()) / static_cast<double>(distinct - 1);
}

/// Where most of the values lie; they get sorted.
double location(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  const std::span<const double> quarter = shortest_half(shortest_half(values));
  constexpr double deviations = 0.637;  // that the middle quarter of a normal distribution is wide
  constexpr double biweight = 2.5;  // deviations: three quarters of the efficiency of the mean, for less clutter in it
  const std::size_t tail = values.size() / 10;
  const double step = step_of(std::span(values).subspan(tail, values.size() - 2 * tail));
  const double width = biweight * std::max(step, (quarter.back() - quarter.front()) / deviations);
  double at = (quarter.front() + quarter.back()) / 2;
  if (!(width > 0)) return at;
  constexpr int most_steps = 50;
  for (int round = 0; round < most_steps; ++round) {
    double sum = 0, weights = 0;
    for (const double value : values) {
      const double u = (value - at) / width;
      if (std::abs(u) >= 1) continue;
      const double weight = (1 - u * u) * (1 - u * u);
      sum += weight * value;
      weights += weight;
    }
    if (!(weights > 0)) break;
    const double next = sum / weights;
    const bool settled = std::abs(next - at) < 1e-4 * width;
    at = next;
    if (settled) break;
  }
  return at;
}

/// How far a plane has to move along its normal.
double shift_of(const PlanePrimitive& primitive, const Cloud& cloud) {
  constexpr std::size_t fewest = 20, most = 20000;
  if (primitive.inliers.size() < fewest) return 0;
  const std::size_t step = (primitive.inliers.size() + most - 1) / most;
  std::vector<double> distances;
  distances.reserve(primitive.inliers.size() / step + 1);
  for (std::size_t i = 0; i < primitive.inliers.size(); i += step)
    distances.push_back(primitive.plane.signed_distance(cloud.points[primitive.inliers[i]].cast<double>()));
  return location(distances);
}

double rms(const PlanePrimitive& primitive, const Cloud& cloud) {
  double squares = 0;
  for (const auto i : primitive.inliers) {
    const double distance = primitive.plane.signed_distance(cloud.points[i].cast<double>());
    squares += distance * distance;
  }
  return std::sqrt(squares / static_cast<double>(primitive.inliers.size()));
}

}  // namespace

Settle::Out Settle::run(const In& in, const Params& params, Context& context) {
  Out out{*in.planes};
  std::vector<double> shifts(out.planes.primitives.size());
  context.parallel_for(
      shifts.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          PlanePrimitive& primitive = out.planes.primitives[i];
          if (primitive.inliers.empty()) continue;
          shifts[i] = std::clamp(shift_of(primitive, *in.planes->cloud), -params.reach, params.reach);
          primitive.plane.offset -= shifts[i];
          primitive.residual = rms(primitive, *in.planes->cloud);
        }
      },
      1);
  double furthest = 0;
  for (const double shift : shifts) furthest = std::max(furthest, std::abs(shift));
  context.info(fmt::format("{} planes moved by {:.1f} mm at most", shifts.size(), 1000 * furthest));
  return out;
}

}  // namespace atrium::plane
