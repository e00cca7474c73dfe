// atrium-polyfit: CGAL's polygonal surface reconstruction for the node baseline.polyfit, which says what it does.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygonal_surface_reconstruction.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/property_map.h>

#include <map>
#include <numeric>
#include <sstream>
#include <string>
#include <tuple>

#include "cbc_program.hpp"
#include "helper_main.hpp"
#include "merged_regions.hpp"
#include "modules/baseline/polyfit_exchange.hpp"

namespace atrium::baseline {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using PointOfPlane = std::tuple<Kernel::Point_3, Kernel::Vector_3, int>;
using Reconstruction = CGAL::Polygonal_surface_reconstruction<Kernel>;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

std::vector<PointOfPlane> points_of(const Exchange& request) {
  std::vector<PointOfPlane> points;
  points.reserve(request.points.size());
  for (std::size_t i = 0; i < request.points.size(); ++i) {
    const auto& [x, y, z] = request.points[i];
    const auto& [u, v, w] = request.normals[i];
    points.emplace_back(Kernel::Point_3(x, y, z), Kernel::Vector_3(u, v, w), request.indices[i]);
  }
  return points;
}

/// The selected faces. Those of one plane share their edges in CGAL's mesh, those of different planes share places.
PlanarPieces pieces_of(const Surface& surface) {
  PlanarPieces pieces;
  std::map<std::array<double, 3>, std::uint32_t> numbers;
  const auto number = [&](const Kernel::Point_3& p) {
    const std::array<double, 3> place{p.x(), p.y(), p.z()};
    const auto [found, fresh] = numbers.try_emplace(place, static_cast<std::uint32_t>(pieces.vertices.size()));
    if (fresh) pieces.vertices.push_back(place);
    return found->second;
  };
  std::vector<std::int32_t> region(surface.num_faces(), -1);
  std::int32_t regions = 0;
  for (const auto seed : surface.faces()) {
    if (region[seed] != -1) continue;
    std::vector<Surface::Face_index> open{seed};
    region[seed] = regions;
    while (!open.empty()) {
      const auto face = open.back();
      open.pop_back();
      for (const auto h : surface.halfedges_around_face(surface.halfedge(face))) {
        const auto neighbour = surface.face(surface.opposite(h));
        if (neighbour == Surface::null_face() || region[neighbour] != -1) continue;
        region[neighbour] = regions;
        open.push_back(neighbour);
      }
    }
    ++regions;
  }
  for (const auto face : surface.faces()) {
    auto& polygon = pieces.polygons.emplace_back();
    for (const auto v : surface.vertices_around_face(surface.halfedge(face)))
      polygon.push_back(number(surface.point(v)));
    pieces.regions.push_back(region[face]);
  }
  return pieces;
}

std::string failure(const Reconstruction& reconstruction, const PolyfitSettings& settings) {
  if (!cbc_report.out_of_time) return reconstruction.error_message();
  std::ostringstream text;
  text << (settings.accept_unproven ? "no surface was found" : "the best surface was not proven")
       << " within the time limit of " << settings.time_limit << " s: a program of " << cbc_report.variables
       << " variables and " << cbc_report.constraints << " constraints\n"
       << "raise 'time_limit' or give it fewer planes ('max_planes')"
       << (settings.accept_unproven ? "" : "; 'on_limit: best' takes the best surface so far, if there is one");
  return text.str();
}

}  // namespace

Exchange computed(const Exchange& request) {
  const auto settings = PolyfitSettings::from(request);
  cbc_settings.deadline = std::chrono::steady_clock::now() +
                          std::chrono::microseconds(static_cast<std::int64_t>(settings.solver_seconds * 1e6));
  cbc_settings.accept_unproven = settings.accept_unproven;
  const auto points = points_of(request);
  Reconstruction reconstruction(points, CGAL::Nth_of_tuple_property_map<0, PointOfPlane>(),
                                CGAL::Nth_of_tuple_property_map<1, PointOfPlane>(),
                                CGAL::Nth_of_tuple_property_map<2, PointOfPlane>());
  Surface candidates;
  reconstruction.output_candidate_faces(candidates);
  Surface surface;
  Exchange reply;
  if (!reconstruction.reconstruct<CbcProgram>(surface, settings.fitting, settings.coverage, settings.complexity)) {
    reply.text = failure(reconstruction, settings);
    return reply;
  }
  const MergedRegions merged = merge_regions(pieces_of(surface));
  reply.points = merged.vertices;
  reply.triangles = merged.triangles;
  reply.indices = merged.regions;
  PolyfitFacts facts;
  facts.candidates = static_cast<double>(candidates.number_of_faces());
  facts.variables = cbc_report.variables;
  facts.constraints = cbc_report.constraints;
  facts.proven = cbc_report.proven;
  facts.objective = cbc_report.objective;
  facts.bound = cbc_report.bound;
  facts.write(reply);
  return reply;
}

}  // namespace atrium::baseline
