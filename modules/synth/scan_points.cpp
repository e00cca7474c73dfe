#include "modules/synth/scan_points.hpp"

#include <algorithm>
#include <numbers>

#include "graph/api/error.hpp"

namespace atrium::synth {
namespace {

std::uint8_t varied(std::uint8_t value, Random& random) {
  return static_cast<std::uint8_t>(
      std::clamp(static_cast<int>(value) + static_cast<int>(random.index(17)) - 8, 0, 255));
}

}  // namespace

Transform pose_of(const Scan::Params& params) {
  constexpr double radian = std::numbers::pi / 180;
  if (params.offset.size() != 3)
    throw Error("offset has " + std::to_string(params.offset.size()) + " numbers", "give three: x, y, z");
  Transform pose;
  pose.rotation = (Eigen::AngleAxisd(params.tilt * radian, Eigen::Vector3d::UnitX()) *
                   Eigen::AngleAxisd(params.yaw * radian, Eigen::Vector3d::UnitZ()))
                      .toRotationMatrix();
  pose.translation = {params.offset[0], params.offset[1], params.offset[2]};
  return pose;
}

Cloud empty_scan(std::size_t points, const Scan::Params& params, const Transform& pose) {
  Cloud cloud;
  cloud.origin = pose.translation;
  cloud.points.resize(points);
  cloud.colours.resize(points);
  cloud.labels.resize(points);
  if (params.sensors) cloud.source.resize(points);
  if (params.normals) cloud.normals.resize(points);
  return cloud;
}

void scan_points(const Scanner& scanner, const Scan::Params& params, const Transform& pose, std::size_t begin,
                 std::size_t end, std::size_t total, Random random, Cloud& cloud, std::size_t at) {
  std::size_t station = 0;
  for (std::size_t i = begin; i < end; ++i, ++at) {
    Echo echo = scanner.look(i, total, station, random);
    const Colour& colour = echo.colour;
    cloud.colours[at] = {varied(colour[0], random), varied(colour[1], random), varied(colour[2], random)};
    const Eigen::Matrix3d turn = pose.rotation * scanner.stations()[echo.station].drift.linear();
    if (params.normals) {
      const bool back = params.random_signs && random.uniform() < 0.5;
      cloud.normals[at] = ((back ? -1.0 : 1.0) * (turn * echo.normal)).cast<float>();
    }
    cloud.points[at] = (pose.rotation * scanner.measure(echo, random)).cast<float>();
    cloud.labels[at] = echo.label;
    if (params.sensors) cloud.source[at] = static_cast<std::uint16_t>(echo.station);
  }
}

}  // namespace atrium::synth
