#pragma once
#include <cstdint>

#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::normal {

enum class Towards { automatic, sensors, inside };

/// Turns normals to the side from which the surface was seen: floors up, ceilings down, both faces of a wall each into
/// its own room. Directions of normals stay; only signs change.
///
/// - sensors: towards the place of the scanner that saw the point (`source`). With several sensors and no sources,
/// towards
///   the nearest sensor. Throws Error if the cloud has no sensor.
/// - inside: towards the free space of the scene. Points are gathered into surfels (voxel, plane), surfels into smooth
///   regions; from each region rays go out to both sides through the occupied voxels, and the region turns to the side
///   where they travel further before they meet a surface. A ray that leaves the scene counts as 0: outside is not free
///   space. The inside of a wall of 12 cm is a short way, the room a long one. Surfaces that see the same on both sides
///   (thin things that stand free) keep the sign of most of their points.
/// - auto: sensors where the cloud has them, else inside.
///
/// Throws Error if the cloud has points but no normals. An empty cloud gives an empty cloud.
struct Orient {
  static constexpr std::string_view type = "normal.orient";
  static constexpr std::string_view summary = "Turns normals towards the sensors, or the inside of the scene.";
  struct In {
    Input<Cloud> cloud;
  };
  struct Out {
    Cloud cloud;
  };
  struct Params {
    Towards towards = Towards::automatic;
    double voxel = 0.05;
    double range = 15;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points with normals.")};
  static constexpr auto outputs = std::tuple{port<&Out::cloud>("The same points, normals turned.")};
  static constexpr auto params = std::tuple{
      param<&Params::towards>(
          {{"auto", Towards::automatic}, {"sensors", Towards::sensors}, {"inside", Towards::inside}},
          "Where normals point to."),
      param<&Params::voxel>(
          metres, within(0.01, 1),
          "Edge of a voxel of the free space (inside); doubled, up to eight times it, until two occupied voxels hold "
          "three points on average. Faces nearer to each other than this are taken for one."),
      param<&Params::range>(metres, within(0.1, 1000), "Length of a ray (inside): the size of the largest room.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::normal
