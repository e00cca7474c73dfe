#include "modules/align/xy_plane.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <complex>
#include <numbers>

#include "modules/geometry/moments.hpp"

namespace atrium::align {
namespace {

constexpr double quarter = 90.0;
constexpr double radians = std::numbers::pi / 180.0;

struct Wall {
  double angle = 0;  ///< of its normal, degrees, modulo 90
  double weight = 0;
};

/// Area of the rectangle with the same second moments as the points: a side of length a has variance a²/12.
double area_of(const PlanePrimitive& primitive, const Cloud& cloud) {
  Moments moments;
  const Eigen::Vector3d reference = cloud.points[primitive.inliers.front()].cast<double>();
  for (const auto i : primitive.inliers) moments.add(cloud.points[i].cast<double>() - reference);
  const PlaneFit fit = fit_plane(moments);
  return 12.0 * std::sqrt(fit.variances[1] * fit.variances[2]);
}

/// Signed difference of two directions modulo 90°, in [−45°, 45°].
double difference(double a, double b) { return std::remainder(a - b, quarter); }

double weight_near(const std::vector<Wall>& walls, double angle, double tolerance) {
  double sum = 0;
  for (const auto& wall : walls)
    if (std::abs(difference(wall.angle, angle)) <= tolerance) sum += wall.weight;
  return sum;
}

/// Weighted mean of the walls near an angle. Fourfold angles make directions 90° apart the same.
double mean_near(const std::vector<Wall>& walls, double angle, double tolerance) {
  std::complex<double> sum = 0;
  for (const auto& wall : walls)
    if (std::abs(difference(wall.angle, angle)) <= tolerance)
      sum += std::polar(wall.weight, 4 * difference(wall.angle, angle) * radians);
  return std::remainder(angle + std::arg(sum) / (4 * radians), quarter);
}

double dominant_angle(const std::vector<Wall>& walls, double tolerance) {
  double best = 0;
  double best_weight = -1;
  for (const auto& wall : walls) {
    const double weight = weight_near(walls, wall.angle, tolerance);
    if (weight > best_weight) {
      best_weight = weight;
      best = wall.angle;
    }
  }
  for (int i = 0; i < 5; ++i) best = mean_near(walls, best, tolerance);
  return best;
}

std::vector<Wall> find_walls(const PlanePrimitives& planes, const XyPlane::Params& params, Context& context) {
  std::vector<Wall> walls(planes.primitives.size());
  const double steepest = std::cos(params.wall_angle * radians);
  context.parallel_for(
      walls.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const auto& primitive = planes.primitives[i];
          const Eigen::Vector3d& n = primitive.plane.normal;
          if (primitive.inliers.empty() || std::abs(n.z()) >= steepest) continue;
          walls[i].angle = std::remainder(std::atan2(n.y(), n.x()) / radians, quarter);
          walls[i].weight = params.weight == DirectionWeight::points ? static_cast<double>(primitive.inliers.size())
                                                                     : area_of(primitive, *planes.cloud);
        }
      },
      1);
  std::erase_if(walls, [](const Wall& wall) { return wall.weight <= 0; });
  return walls;
}

}  // namespace

XyPlane::Out XyPlane::run(const In& in, const Params& params, Context& context) {
  const Transform before = in.transform ? *in.transform : Transform{};
  const std::vector<Wall> walls = find_walls(*in.planes, params, context);
  double total = 0;
  for (const auto& wall : walls) total += wall.weight;
  const double angle = walls.empty() ? 0 : dominant_angle(walls, params.tolerance);
  const double share = total > 0 ? weight_near(walls, angle, params.tolerance) / total : 0;
  if (walls.empty() || share < params.min_share) {
    context.info(walls.empty()
                     ? std::string("no vertical plane: the scene is left as it is")
                     : fmt::format("no dominant direction ({:.0f} % of the walls agree): the scene is left as it is",
                                   100 * share));
    return {in.planes, before};
  }
  Transform turn;
  const double yaw = angle >= quarter / 2 ? angle - quarter : angle;  // the turn, −yaw, is in (−45°, 45°]
  turn.rotation = Eigen::AngleAxisd(-yaw * radians, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  context.info(fmt::format("turned by {:.2f} deg; {:.0f} % of the walls agree", -yaw, 100 * share));
  return {std::make_shared<const PlanePrimitives>(transformed(*in.planes, turn)), chained(before, turn)};
}

}  // namespace atrium::align
