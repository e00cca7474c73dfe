#include "modules/baseline/ksr.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "modules/baseline/helper_program.hpp"
#include "modules/baseline/ksr_exchange.hpp"

namespace atrium::baseline {
namespace {

void check(const Cloud& cloud) {
  if (cloud.size() < 3) throw Error(fmt::format("planes need at least 3 points, the cloud has {}", cloud.size()));
  if (!cloud.has_normals()) throw Error("the cloud has no normals", "normal.estimate and normal.orient make them");
}

Exchange request_of(const Cloud& cloud, const Ksr::Params& params) {
  Exchange request;
  KsrSettings{params.distance,
              params.normal_angle,
              static_cast<double>(params.min_points),
              static_cast<double>(params.neighbours),
              params.regularise,
              params.angle_tolerance,
              params.max_offset,
              params.oriented_box,
              static_cast<double>(params.crossings),
              params.lambda}
      .write(request);
  const float side = params.indoors ? -1.0F : 1.0F;
  request.points.reserve(cloud.size());
  request.normals.reserve(cloud.size());
  for (const auto& p : cloud.points) request.points.push_back({p.x(), p.y(), p.z()});
  for (const auto& n : cloud.normals) request.normals.push_back({side * n.x(), side * n.y(), side * n.z()});
  return request;
}

}  // namespace

Ksr::Out Ksr::run(const In& in, const Params& params, Context& context) {
  check(*in.cloud);
  HelperProgram helper;
  helper.name = "atrium-ksr";
  helper.lacks =
      "it is built with CGAL 6.0 or later (on Debian 12: unpack a later Debian's libcgal-dev with dpkg-deb -x into a "
      "folder F): cmake -B build -DATRIUM_CGAL=ON -DCGAL_DIR=F/usr/lib/x86_64-linux-gnu/cmake/CGAL (CGAL's "
      "reconstruction is under the GNU GPL)";
  helper.seconds = params.time_limit;
  helper.mebibytes = params.memory_limit;
  const HelperResult result = run_helper(helper, request_of(*in.cloud, params), context);

  Out out;
  out.mesh.origin = in.cloud->origin;
  for (const auto& [x, y, z] : result.reply.points) out.mesh.vertices.emplace_back(x, y, z);
  out.mesh.triangles = result.reply.triangles;
  if (params.indoors)
    for (auto& t : out.mesh.triangles) std::swap(t[1], t[2]);
  out.mesh.primitives = result.reply.indices;
  const auto facts = KsrFacts::from(result.reply);
  const auto last = std::max_element(out.mesh.primitives.begin(), out.mesh.primitives.end());
  const double polygons = last == out.mesh.primitives.end() ? 0 : 1.0 + *last;
  out.report.values = {
      {"ksr.planes", facts.planes, ""}, {"ksr.volumes", facts.volumes, ""}, {"ksr.polygons", polygons, ""}};
  context.info(fmt::format("{} planes, {} volumes, {} triangles; {:.1f} s, {:.0f} MiB", facts.planes, facts.volumes,
                           out.mesh.triangles.size(), result.seconds, result.mebibytes));
  if (out.mesh.triangles.empty()) context.warn("everything is outside of the surface: the mesh is empty");
  return out;
}

}  // namespace atrium::baseline
