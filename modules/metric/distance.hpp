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
/// area, to the nearest point; mean, RMS and 95 % are weighted by area, the maximum takes in the vertices too. Both
/// count every surface: a mesh of the structure alone is far from the points on furniture.
///
/// Metrics: distance.diagonal, then distance.{cloud_to_mesh,mesh_to_cloud}.{mean,rms,p95,max} in m and the same names
/// under distance.….relative. The frames may have different origins. Error: a cloud without points, a mesh without
/// area.
struct Distance {
  static constexpr std::string_view type = "metric.distance";
  static constexpr std::string_view summary = "Distances between a cloud and a mesh, in both directions.";
  struct In {
    Input<Cloud> cloud;
    Input<Mesh> mesh;
  };
  struct Out {
    Metrics metrics;
  };
  struct Params {
    double spacing = 0.05;
    std::int64_t max_samples = 1'000'000;
  };
  static constexpr auto inputs =
      std::tuple{port(&In::cloud, "cloud", "The scan."), port(&In::mesh, "mesh", "The mesh, in the cloud's frame.")};
  static constexpr auto outputs = std::tuple{port(&Out::metrics, "metrics", "distance.…: metres and shares.")};
  static constexpr auto params = std::tuple{
      param(&Params::spacing, "spacing", metres, within(1e-4, 100), "Of the mesh's samples: one per spacing²."),
      param(&Params::max_samples, "max_samples", count, within(1, 1e9),
            "With a mesh so large that it would take more, samples stand further apart."),
  };
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::metric
