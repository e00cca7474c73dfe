#include "modules/synth/scan.hpp"

#include "modules/synth/scan_points.hpp"

namespace atrium::synth {
namespace {

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
  const auto total = static_cast<std::size_t>(params.points);
  Cloud cloud = empty_scan(total, params, pose);
  if (params.sensors)
    for (const auto& s : scanner.stations())
      cloud.sensors.push_back((pose.rotation * (s.drift * s.place)).cast<float>());
  context.parallel_chunks(total, scan_chunk, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    scan_points(scanner, params, pose, begin, end, total, context.random(chunk + 1), cloud, begin);
  });
  return cloud;
}

}  // namespace

Scan::Out Scan::run(const In& in, const Params& params, Context& context) {
  const SimulatedScene& scene = *in.scene;
  const Transform pose = pose_of(params);
  const Scanner scanner(scene, params, context);
  Out out;
  out.cloud = scan(scanner, params, pose, context);
  if (params.shuffle) shuffle(out.cloud, context.random(~std::uint64_t{0}), context);
  out.truth = transformed(scene.truth, pose);
  out.mesh = out.truth.mesh;
  return out;
}

}  // namespace atrium::synth
