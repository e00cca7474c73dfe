#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/mesh.hpp"
#include "modules/types/metrics.hpp"

namespace atrium::baseline {

/// Closed surface by kinetic reconstruction (Bauchet and Lafarge, "Kinetic shape reconstruction", ACM Transactions on
/// Graphics 39(5), 2020). Planes found by region growing, and made regular, grow as polygons until they meet; so they
/// cut the bounding box into far fewer cells than planes without end do. A minimum cut calls each cell inside or
/// outside, by the side from which its points were seen and for a small area between the two; the surface lies between
/// them.
///
/// The implementation is CGAL's, in the helper program atrium-ksr, which has CGAL's licence: the GNU GPL. It needs CGAL
/// 6.0 or later, more than Debian 12 has: the headers of a later Debian's libcgal-dev are enough, unpacked anywhere.
/// Where the program is not built, the node's run fails and says how to get it.
///
/// The method is made for objects that are seen from outside, whose normals point out of what is solid. Indoors the
/// space that is seen takes the place of the solid (`indoors`). Triangles are counter-clockwise seen from where the
/// points were seen, in the cloud's frame; mesh.primitives says which planar polygon a triangle is of. Errors: no
/// normals; fewer than 3 points; no plane; no helper program; a limit that was reached. An empty mesh, with a warning,
/// where all is outside.
struct Ksr {
  static constexpr std::string_view type = "baseline.ksr";
  static constexpr std::string_view summary =
      "Closed polygonal surface by kinetic reconstruction: needs the GPL helper.";
  struct In {
    Input<Cloud> cloud;
  };
  struct Out {
    Mesh mesh;
    Metrics report;
  };
  struct Params {
    double distance = 0.03;
    double normal_angle = 25;
    std::int64_t min_points = 0;
    std::int64_t neighbours = 12;
    bool regularise = true;
    double angle_tolerance = 5;
    double max_offset = 0.03;
    bool oriented_box = false;
    std::int64_t crossings = 1;
    double lambda = 0.3;
    bool indoors = true;
    double time_limit = 600;
    double memory_limit = 8192;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points with oriented normals.")};
  static constexpr auto outputs =
      std::tuple{port<&Out::mesh>("The closed surface, each triangle with the number of its planar polygon."),
                 port<&Out::report>("ksr.…: planes found, volumes of the partition, polygons.")};
  static constexpr auto params = std::tuple{
      param<&Params::distance>(metres, within(1e-6, 10), "Largest distance of a point from its plane."),
      param<&Params::normal_angle>(degrees, within(1, 89), "Largest angle between a point's normal and its plane's."),
      param<&Params::min_points>(count, within(0, 1e9), "Smallest plane. 0: one in 200 of the points."),
      param<&Params::neighbours>(count, within(3, 1000), "Nearest points over which a region grows."),
      param<&Params::regularise>("Whether planes are made parallel, orthogonal and coplanar."),
      param<&Params::angle_tolerance>(degrees, within(0, 45), "Up to which angle they are."),
      param<&Params::max_offset>(metres, within(0, 10), "Parallel planes nearer than this become one."),
      param<&Params::oriented_box>("Whether the partition's box follows the points' directions instead of the axes."),
      param<&Params::crossings>(count, within(1, 100),
                                "How many others a growing polygon passes before it stops (the publication's k)."),
      param<&Params::lambda>(
          ratio, within(0, 0.999),
          "Few and small faces (towards 1) against faithfulness to the points (0); indoors 0.1 to 0.5 is of use."),
      param<&Params::indoors>("Whether points are on the walls around what is seen, not on an object."),
      param<&Params::time_limit>(seconds, within(0.01, 1e6), "Wall time of the helper."),
      param<&Params::memory_limit>(count, within(64, 1e7), "Resident memory of the helper, in MiB.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::baseline
