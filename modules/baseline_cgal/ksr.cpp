// atrium-ksr: CGAL's kinetic surface reconstruction for the node baseline.ksr, which says what it does.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Kinetic_surface_reconstruction_3.h>
#include <CGAL/Point_set_3.h>

#include <iterator>
#include <map>
#include <numeric>
#include <vector>

#include "helper_main.hpp"
#include "merged_regions.hpp"
#include "modules/baseline/ksr_exchange.hpp"

namespace atrium::baseline {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Points = CGAL::Point_set_3<Kernel::Point_3>;
using Reconstruction = CGAL::Kinetic_surface_reconstruction_3<Kernel, Points, Points::Point_map, Points::Vector_map>;

Points points_of(const Exchange& request) {
  Points points(true);  // with normals
  points.reserve(request.points.size());
  for (std::size_t i = 0; i < request.points.size(); ++i) {
    const auto& [x, y, z] = request.points[i];
    const auto& [u, v, w] = request.normals[i];
    points.insert(Kernel::Point_3(x, y, z), Kernel::Vector_3(u, v, w));
  }
  return points;
}

/// CGAL gives every connected piece of a plane as one polygon, which runs to its holes and back.
PlanarPieces pieces_of(Reconstruction& reconstruction, double lambda) {
  std::map<Reconstruction::KSP::Face_support, bool> sides;  // of the bounding box: all outside
  for (const auto side : {Reconstruction::KSP::ZMIN, Reconstruction::KSP::YMIN, Reconstruction::KSP::XMAX,
                          Reconstruction::KSP::YMAX, Reconstruction::KSP::XMIN, Reconstruction::KSP::ZMAX})
    sides[side] = false;
  std::vector<Kernel::Point_3> places;
  std::vector<std::vector<std::size_t>> polygons;
  reconstruction.reconstruct(lambda, sides, std::back_inserter(places), std::back_inserter(polygons));
  PlanarPieces pieces;
  for (const auto& p : places) pieces.vertices.push_back({p.x(), p.y(), p.z()});
  for (const auto& polygon : polygons) pieces.polygons.emplace_back(polygon.begin(), polygon.end());
  pieces.regions.resize(polygons.size());
  std::iota(pieces.regions.begin(), pieces.regions.end(), 0);
  return pieces;
}

}  // namespace

Exchange computed(const Exchange& request) {
  const auto settings = KsrSettings::from(request);
  Points points = points_of(request);
  Reconstruction reconstruction(points);
  const double fewest = settings.min_points > 0 ? settings.min_points : 0.005 * static_cast<double>(points.size());
  KsrFacts facts;
  Exchange reply;
  facts.planes = static_cast<double>(
      reconstruction.detect_planar_shapes(CGAL::parameters::maximum_distance(settings.distance)
                                              .maximum_angle(settings.normal_angle)
                                              .minimum_region_size(static_cast<std::size_t>(std::max(3.0, fewest)))
                                              .k_neighbors(static_cast<std::size_t>(settings.neighbours))
                                              .regularize_coplanarity(settings.regularise)
                                              .regularize_parallelism(settings.regularise)
                                              .regularize_orthogonality(settings.regularise)
                                              .angle_tolerance(settings.angle_tolerance)
                                              .maximum_offset(settings.max_offset)));
  if (facts.planes < 1) {
    reply.text = "no plane was found\nallow a larger 'distance' or 'normal_angle', or fewer 'min_points'";
    return reply;
  }
  reconstruction.initialize_partition(CGAL::parameters::reorient_bbox(settings.oriented_box));
  reconstruction.partition(static_cast<std::size_t>(settings.crossings));
  facts.volumes = static_cast<double>(reconstruction.kinetic_partition().number_of_volumes());
  const MergedRegions merged = merge_regions(pieces_of(reconstruction, settings.lambda));
  reply.points = merged.vertices;
  reply.triangles = merged.triangles;
  reply.indices = merged.regions;
  facts.write(reply);
  return reply;
}

}  // namespace atrium::baseline
