#pragma once
#include "graph/api/node.hpp"
#include "modules/types/mesh.hpp"
#include "modules/types/metrics.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::baseline {

/// Closed surface from planes by PolyFit (Nan and Wonka, "PolyFit: Polygonal surface reconstruction from point clouds",
/// ICCV 2017), one of the methods that the paper compares with. All planes cut each other into candidate faces; a
/// binary program chooses those that fit the points, cover their area and have few sharp edges, such that every edge
/// has two faces or none: the surface is closed and of planes. What is seen from one side only (a room) is closed just
/// so.
///
/// The implementation is CGAL's polygonal surface reconstruction with CBC as the solver, in the helper program
/// atrium-polyfit, which has CGAL's licence: the GNU GPL. It is built where CMake is told so (-DATRIUM_CGAL=ON,
/// Debian's packages libcgal-dev and coinor-libcbc-dev); elsewhere the node's run fails and says that. CGAL fits the
/// planes to their inliers again, and joins those that are nearly one (less than 10° apart, a fifth of the smaller
/// one's points near the other). It has neither a height nor a wall thickness to go by: planes that do not belong to
/// the structure cut all others.
///
/// Candidates grow with the cube of the number of planes, the solver's time faster still: give it the large planes
/// only. A run that ends within its limits gives the same bytes every time.
///
/// The chosen faces of one plane that touch are joined and triangulated without further corners; triangles are
/// counter-clockwise seen from the side from which the planes of their closed part were seen. Errors: no normals; fewer
/// than 4 planes; no helper program; a limit that was reached; a solver that gave up. An empty mesh, with a warning,
/// where no surface is better than any.
struct Polyfit {
  static constexpr std::string_view type = "baseline.polyfit";
  static constexpr std::string_view summary = "Closed polygonal surface by PolyFit (CGAL, CBC): needs the GPL helper.";
  enum class OnLimit { fail, best };
  struct In {
    Input<PlanePrimitives> planes;
  };
  struct Out {
    Mesh mesh;
    Metrics report;
  };
  struct Params {
    std::int64_t max_planes = 50;
    double fitting = 0.43;
    double coverage = 0.27;
    double complexity = 0.30;
    double time_limit = 600;
    double memory_limit = 8192;
    OnLimit on_limit = OnLimit::fail;
  };
  static constexpr auto inputs =
      std::tuple{port<&In::planes>("Planes over a cloud with normals; only their inliers count.")};
  static constexpr auto outputs = std::tuple{
      port<&Out::mesh>("The closed surface, in the planes' frame, each triangle with its primitive."),
      port<&Out::report>(
          "polyfit.…: planes, candidate_faces, variables, constraints of the program; proven: 1 if the surface is the "
          "best one, and gap: by what share of its value a better one could still be better.")};
  static constexpr auto params = std::tuple{
      param<&Params::max_planes>(count, within(4, 10'000),
                                 "Use this many planes, the largest first, and warn about the rest."),
      param<&Params::fitting>(ratio, within(0, 1), "Weight of the data fitting (the publication's λ_f)."),
      param<&Params::coverage>(ratio, within(0, 1), "Weight of the point coverage (λ_c)."),
      param<&Params::complexity>(ratio, within(0, 1), "Weight of the model complexity (λ_m)."),
      param<&Params::time_limit>(seconds, within(0.01, 1e6),
                                 "Wall time of the helper, candidates and solver together."),
      param<&Params::memory_limit>(count, within(64, 1e7), "Resident memory of the helper, in MiB."),
      param<&Params::on_limit>(
          {{"fail", OnLimit::fail}, {"best", OnLimit::best}},
          "When the time ends before the best surface is proven: fail, or take the best one so far with a warning "
          "(which surface that is depends on the machine; the solver looks at its clock between the steps of its "
          "work, so this may take up to twice the limit, and fails then). Memory always fails.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::baseline
