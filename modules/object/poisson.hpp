#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::object {

/// Surface of the objects by screened Poisson reconstruction (paper: "a surface reconstruction technique"; Kazhdan and
/// Hoppe 2013, the implementation of PCL).
///
/// Poisson's surface is closed, so where nothing was seen it is guessed. PCL gives no sample density to cut that away;
/// instead, triangles with a corner or their middle further than `trim` from the nearest point are dropped. Both it and
/// the depth can follow the points' spacing (surface_spacing): with a fixed depth the cells grow with the building, and
/// beyond the trim much of the furniture is dropped. Where half of the points have 16 copies there is no spacing: depth
/// 8 and 6 cm stand for it, with a warning. Colours are those of the nearest points. Normals must point to the side
/// from which the surface was seen; triangles are counter-clockwise from there.
///
/// PCL's solver adds in the order in which threads arrive, so it runs on one thread: same input, same bytes. Its octree
/// keeps state for the whole program, so reconstructions wait for each other. Fewer than 10 points, or all in one
/// place: an empty mesh. Errors: points without normals; a depth of 1 or 2.
struct Poisson {
  static constexpr std::string_view type = "object.poisson";
  static constexpr std::string_view summary =
      "Surface of the objects by Poisson reconstruction, trimmed to the points.";
  struct In {
    Input<Cloud> cloud;
  };
  struct Out {
    Mesh mesh;
  };
  struct Params {
    std::int64_t depth = 0;
    double samples_per_node = 1.5;
    double point_weight = 4;
    double trim = 0.06;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points of the objects, with normals.")};
  static constexpr auto outputs = std::tuple{port<&Out::mesh>("Their surface, in the cloud's frame.")};
  static constexpr auto params = std::tuple{
      param<&Params::depth>(
          count, within(0, 12),
          "Depth of the octree, from 3 on: the finest cell is the cloud's extent times 1.1 over 2^depth. Each step "
          "more "
          "costs about four times the time and memory where points are dense enough. 0: the least from 8 on with which "
          "a cell is at most five times the points' spacing."),
      param<&Params::samples_per_node>(
          count, within(1, 50),
          "Least number of points in a cell of the octree: 1 to 5 for clean points, up to 20 for noisy ones."),
      param<&Params::point_weight>(
          unitless, within(0, 100),
          "How strongly the surface is drawn to the points themselves; 0 is unscreened Poisson (Kazhdan 2006)."),
      param<&Params::trim>(
          metres, within(0, 10),
          "Triangles further than this from the nearest point are dropped. 0: three times the points' spacing.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::object
