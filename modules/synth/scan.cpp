#include "modules/synth/scan.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

#include "modules/synth/scanner.hpp"

namespace atrium::synth {
namespace {

constexpr double radians = std::numbers::pi / 180;
constexpr std::size_t chunk_size = 16384;

std::uint8_t varied(std::uint8_t value, Random& random) {
  return static_cast<std::uint8_t>(
      std::clamp(static_cast<int>(value) + static_cast<int>(random.index(17)) - 8, 0, 255));
}

void allocate(Cloud& cloud, std::size_t total, const Scan::Params& params) {
  cloud.points.resize(total);
  cloud.colours.resize(total);
  cloud.labels.resize(total);
  if (params.sensors) cloud.source.resize(total);
  if (params.normals) cloud.normals.resize(total);
}

// Moves place from[i] of every column to i, with from the same random order for all.
void shuffle(Cloud& cloud, Random random, const Context& context) {
  std::vector<std::uint32_t> from(cloud.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    const auto k = static_cast<std::size_t>(random.index(i + 1));
    from[i] = from[k];
    from[k] = static_cast<std::uint32_t>(i);
  }
  const auto gather = [&](auto& column) {
    if (column.empty()) return;
    auto moved = column;
    context.parallel_for(from.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) moved[i] = column[from[i]];
    });
    column = std::move(moved);
  };
  gather(cloud.points);
  gather(cloud.colours);
  gather(cloud.labels);
  gather(cloud.source);
  gather(cloud.normals);
}

Cloud scan(const Scanner& scanner, const Scan::Params& params, const Transform& pose, const Context& context) {
  Cloud cloud;
  const auto total = static_cast<std::size_t>(params.points);
  allocate(cloud, total, params);
  cloud.origin = pose.translation;
  if (params.sensors)
    for (const auto& s : scanner.stations())
      cloud.sensors.push_back((pose.rotation * (s.drift * s.place)).cast<float>());
  context.parallel_chunks(total, chunk_size, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    Random random = context.random(chunk + 1);
    std::size_t station = 0;
    for (std::size_t i = begin; i < end; ++i) {
      Echo echo = scanner.look(i, total, station, random);
      const Colour& colour = echo.colour;
      cloud.colours[i] = {varied(colour[0], random), varied(colour[1], random), varied(colour[2], random)};
      const Eigen::Matrix3d turn = pose.rotation * scanner.stations()[echo.station].drift.linear();
      if (params.normals) {
        const bool back = params.random_signs && random.uniform() < 0.5;
        cloud.normals[i] = ((back ? -1.0 : 1.0) * (turn * echo.normal)).cast<float>();
      }
      cloud.points[i] = (pose.rotation * scanner.measure(echo, random)).cast<float>();
      cloud.labels[i] = echo.label;
      if (params.sensors) cloud.source[i] = static_cast<std::uint16_t>(echo.station);
    }
  });
  return cloud;
}

}  // namespace

Scan::Out Scan::run(const In& in, const Params& params, Context& context) {
  const SimulatedScene& scene = *in.scene;
  if (params.offset.size() != 3)
    throw Error("offset has " + std::to_string(params.offset.size()) + " numbers", "give three: x, y, z");
  Transform pose;
  pose.rotation = (Eigen::AngleAxisd(params.tilt * radians, Eigen::Vector3d::UnitX()) *
                   Eigen::AngleAxisd(params.yaw * radians, Eigen::Vector3d::UnitZ()))
                      .toRotationMatrix();
  pose.translation = {params.offset[0], params.offset[1], params.offset[2]};
  const Scanner scanner(scene, params, context);
  Out out;
  out.cloud = scan(scanner, params, pose, context);
  if (params.shuffle) shuffle(out.cloud, context.random(~std::uint64_t{0}), context);
  out.truth = transformed(scene.truth, pose);
  out.mesh = out.truth.mesh;
  return out;
}

}  // namespace atrium::synth
