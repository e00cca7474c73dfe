#include "modules/baseline/polyfit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "modules/baseline/helper_program.hpp"
#include "modules/baseline/polyfit_exchange.hpp"
#include "modules/baseline/sided_regions.hpp"

namespace atrium::baseline {
namespace {

constexpr std::size_t least_planes = 4;  // of a closed surface

std::size_t planes_to_use(const PlanePrimitives& planes, const Polyfit::Params& params, const Context& context) {
  const std::size_t all = planes.primitives.size();
  const std::size_t used = std::min(all, static_cast<std::size_t>(params.max_planes));
  if (used < least_planes)
    throw Error(fmt::format("PolyFit needs at least 4 planes to close a surface, there are {}", all),
                "look at the node that finds the planes: its largest distance and smallest plane");
  if (!planes.cloud->has_normals())
    throw Error("the planes' cloud has no normals", "normal.estimate and normal.orient make them");
  if (used < all) context.warn(fmt::format("{} planes of {} are used, the largest, as 'max_planes' says", used, all));
  return used;
}

Exchange request_of(const PlanePrimitives& planes, std::size_t used, const Polyfit::Params& params) {
  constexpr double share_of_solver = 0.97;  // the rest is for handing over
  Exchange request;
  PolyfitSettings{params.fitting,
                  params.coverage,
                  params.complexity,
                  params.time_limit,
                  params.time_limit * share_of_solver,
                  params.on_limit == Polyfit::OnLimit::best}
      .write(request);
  const auto row = [](const Eigen::Vector3f& v) { return std::array<double, 3>{v.x(), v.y(), v.z()}; };
  for (std::size_t i = 0; i < used; ++i)
    for (const std::uint32_t k : planes.primitives[i].inliers) {
      request.points.push_back(row(planes.cloud->points[k]));
      request.normals.push_back(row(planes.cloud->normals[k]));
      request.indices.push_back(static_cast<std::int32_t>(i));
    }
  return request;
}

Metrics report_of(const PolyfitFacts& facts, std::size_t planes) {
  Metrics report;
  const double scale = std::max({std::abs(facts.objective), std::abs(facts.bound), 1e-9});
  const double gap = facts.proven ? 0 : std::abs(facts.objective - facts.bound) / scale;
  report.values = {
      {"polyfit.planes", static_cast<double>(planes), ""}, {"polyfit.candidate_faces", facts.candidates, ""},
      {"polyfit.variables", facts.variables, ""},          {"polyfit.constraints", facts.constraints, ""},
      {"polyfit.proven", facts.proven ? 1.0 : 0.0, ""},    {"polyfit.gap", gap, ""}};
  return report;
}

}  // namespace

Polyfit::Out Polyfit::run(const In& in, const Params& params, Context& context) {
  const std::size_t used = planes_to_use(*in.planes, params, context);
  HelperProgram helper;
  helper.name = "atrium-polyfit";
  helper.lacks =
      "it is built on Debian with: apt-get install libcgal-dev coinor-libcbc-dev; cmake -B build -DATRIUM_CGAL=ON "
      "(CGAL's reconstruction is under the GNU GPL)";
  // The solver looks at its clock between the steps of its work.
  helper.seconds = params.on_limit == OnLimit::best ? 2 * params.time_limit : params.time_limit;
  helper.mebibytes = params.memory_limit;
  const HelperResult result = run_helper(helper, request_of(*in.planes, used, params), context);

  Out out;
  const auto facts = PolyfitFacts::from(result.reply);
  out.report = report_of(facts, used);
  out.mesh.origin = in.planes->cloud->origin;
  for (const auto& [x, y, z] : result.reply.points) out.mesh.vertices.emplace_back(x, y, z);
  out.mesh.triangles = result.reply.triangles;
  take_sides(out.mesh, result.reply.indices, *in.planes, used);
  context.info(fmt::format("{} planes, {} candidate faces, {} triangles; {:.1f} s, {:.0f} MiB", used, facts.candidates,
                           out.mesh.triangles.size(), result.seconds, result.mebibytes));
  if (!facts.proven)
    context.warn(fmt::format("the time ended before the best surface was proven: this one may be {:.2g} % worse",
                             100 * out.report.values.back().value));
  if (out.mesh.triangles.empty())
    context.warn("no closed surface of these planes is better than none: the mesh is empty");
  return out;
}

}  // namespace atrium::baseline
