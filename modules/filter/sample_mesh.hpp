#pragma once
#include <cstdint>

#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::filter {

/// Samples the surface of a mesh evenly by Poisson disks (paper, data set preparation: as many points as the mesh has
/// vertices). Normals come from the faces, colours are interpolated, the origin is kept. Throws Error if the mesh has
/// no surface.
struct SampleMesh {
  static constexpr std::string_view type = "filter.sample_mesh";
  static constexpr std::string_view summary = "Samples points on the surface of a mesh by Poisson disks.";
  static constexpr bool random = true;
  struct In {
    Input<Mesh> mesh;
  };
  struct Out {
    Cloud cloud;
  };
  struct Params {
    std::int64_t count = 0;
  };
  static constexpr auto inputs = std::tuple{port<&In::mesh>("Triangles, with colours or without.")};
  static constexpr auto outputs = std::tuple{port<&Out::cloud>("Points with normals, in the mesh's frame.")};
  static constexpr auto params = std::tuple{
      param<&Params::count>(atrium::count, within(0, 1e8), "Number of points; 0: as many as the mesh has vertices.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::filter
