#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/mesh.hpp"
#include "modules/types/metrics.hpp"

namespace atrium::metric {

/// Distances between a cloud and a mesh (the paper's error, "RMSE by Hausdorff distance", which leaves direction and
/// unit open: both directions, in metres and as a share of the cloud's bounding box's diagonal).
///
/// cloud_to_mesh: every point to the nearest triangle, exact. mesh_to_cloud: samples of the mesh, spread evenly by
/// area, to the nearest point; all figures but the maximum, which takes in the vertices too, are weighted by area. Both
/// count every surface: a mesh of the structure alone is far from the points on furniture.
///
/// A few wild points spoil a mean square. So beside mean, rms and max stand: median; p95, the distance that 95 % are
/// within; trimmed_rms, the RMS of those 95 %; beyond, the share that is further than `limit`, and within_rms, the RMS
/// of the rest (left out if there is none).
///
/// Of the structure alone, if `structure` is wired: distance.structure.mesh_to_cloud from its surface to the whole
/// cloud; with `truth` also distance.structure.cloud_to_mesh from those points to it that are within truth_distance of
/// the true structure, so that furniture counts in neither.
///
/// Metrics: distance.diagonal, then distance.{cloud_to_mesh,mesh_to_cloud}.{mean,rms,median,p95,trimmed_rms,max,
/// within_rms} in m, .beyond as a share, and under distance.….relative the same lengths (but within_rms) over the
/// diagonal. The frames may have different origins. Errors: a cloud without points or with one that is not finite, a
/// mesh without area, truth without structure, a truth without area. A structure without area, or no point near the
/// truth: a warning, and left out.
struct Distance {
  static constexpr std::string_view type = "metric.distance";
  static constexpr int version = 2;
  static constexpr std::string_view summary = "Distances between a cloud and a mesh, in both directions.";
  struct In {
    Input<Cloud> cloud;
    Input<Mesh> mesh;
    OptionalInput<Mesh> structure;
    OptionalInput<Mesh> truth;
  };
  struct Out {
    Metrics metrics;
  };
  struct Params {
    double limit = 0.1;
    double truth_distance = 0.05;
    double spacing = 0.05;
    std::int64_t max_samples = 1'000'000;
  };
  static constexpr auto inputs =
      std::tuple{port<&In::cloud>("The scan."), port<&In::mesh>("The mesh, in the cloud's frame."),
                 port<&In::structure>("Its walls, floors and ceilings alone, in the same frame."),
                 port<&In::truth>("The true walls, floors and ceilings, in the same frame.")};
  static constexpr auto outputs = std::tuple{port<&Out::metrics>("distance.…: metres and shares.")};
  static constexpr auto params = std::tuple{
      param<&Params::limit>(metres, within(0, 1000), "What is further counts as beyond."),
      param<&Params::truth_distance>(metres, within(0, 1000),
                                     "Points this near to the true structure are the structure's."),
      param<&Params::spacing>(metres, within(1e-4, 100), "Of the mesh's samples: one per spacing²."),
      param<&Params::max_samples>(count, within(1, 1e9),
                                  "With a mesh so large that it would take more, samples stand further apart."),
  };
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::metric
