#include "modules/synth/write_scan.hpp"

#include <algorithm>

#include "graph/api/error.hpp"
#include "modules/io/cloud_stream.hpp"
#include "modules/io/paths.hpp"
#include "modules/synth/scan_points.hpp"

namespace atrium::synth {
namespace {

Scan::Params scan_params(const WriteScan::Params& from) {
  Scan::Params params;
  params.points = from.points;
  params.pattern = from.pattern;
  params.positions = from.positions;
  params.noise = from.noise;
  params.outliers = from.outliers;
  params.drift = from.drift;
  params.outside = from.outside;
  params.windows = from.windows;
  params.people = from.people;
  params.yaw = from.yaw;
  params.tilt = from.tilt;
  params.offset = from.offset;
  params.sensors = false;  // the pieces need no column for them
  return params;
}

io::StreamedCloud announced(const Scanner& scanner, const WriteScan::Params& params, const SimulatedScene& scene,
                            const Transform& pose) {
  io::StreamedCloud cloud;
  cloud.points = static_cast<std::size_t>(params.points);
  cloud.origin = pose.translation;
  cloud.colours = cloud.labels = true;
  cloud.lowest_label = -4 - static_cast<std::int32_t>(scene.objects.size());  // people, see synth.scan
  cloud.highest_label = std::max<std::int32_t>(0, static_cast<std::int32_t>(scene.truth.faces.size()) - 1);
  if (!params.sensors || params.pattern == Scan::Pattern::uniform_area) return cloud;
  const std::size_t count = scanner.stations().size();
  for (std::size_t s = 0; s < count; ++s) {
    const auto& station = scanner.stations()[s];
    const std::size_t first = s * cloud.points / count, last = (s + 1) * cloud.points / count;
    cloud.scans.push_back({pose.translation + pose.rotation * (station.drift * station.place), last - first});
  }
  return cloud;
}

}  // namespace

WriteScan::Out WriteScan::run(const In& in, const Params& params, Context& context) {
  constexpr std::size_t round_chunks = 64;
  const std::string extension = io::extension_of(params.path.path);
  const Scan::Params scan = scan_params(params);
  const Transform pose = pose_of(scan);
  const Scanner scanner(*in.scene, scan, context);
  const auto total = static_cast<std::size_t>(params.points);
  const auto target = context.output(params.path.path);
  AtomicFile file(target);
  const auto stream = io::cloud_stream(announced(scanner, params, *in.scene, pose), extension, file, context);
  for (std::size_t first = 0; first < total; first += round_chunks * scan_chunk) {
    const std::size_t last = std::min(total, first + round_chunks * scan_chunk);
    Cloud piece = empty_scan(last - first, scan, pose);
    context.parallel_chunks(last - first, scan_chunk, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
      scan_points(scanner, scan, pose, first + begin, first + end, total,
                  context.random(first / scan_chunk + chunk + 1), piece, begin);
    });
    stream->append(piece);
    context.progress(static_cast<double>(last) / static_cast<double>(total));
  }
  stream->finish();
  file.commit();
  context.wrote(target);
  Out out;
  out.truth = transformed(in.scene->truth, pose);
  out.mesh = out.truth.mesh;
  return out;
}

}  // namespace atrium::synth
