#pragma once
#include "graph/api/node.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::baseline {

/// Plane-aware decimation after Wang and Guo, "Plane-based optimization of geometry and texture for RGB-D
/// reconstruction of indoor scenes", 3DV 2018: the paper's comparison method plane-opt-rgbd, in its geometry (an own
/// implementation; texture optimisation is no part of it).
///
/// 1. The mesh is cut into planar regions: they grow over neighbouring triangles within `distance` and `angle`, are
///    joined where one plane serves two, and are given up below `min_area`: their triangles are free.
/// 2. Vertices go onto their planes; those between two regions onto the line where these meet, those between three onto
///    the point, if it is within three times `distance`.
/// 3. Edges are collapsed by least quadric error (Garland and Heckbert 1997), in which a triangle of a region stands
///    for the region's plane. Inside of a region vertices move freely in the plane, on borders only along them; where
///    three regions meet they stay. Edges whose collapse would change the topology (link condition, Dey et al. 1999),
///    or turn a triangle over, are kept, so a closed manifold stays one.
/// 4. If that is not enough for a target, borders and corners are collapsed too, still by least error: small patches
///    of furniture go before a wall's edge. A line in the log says from how many triangles on.
///
/// It ends at the target, or where every other collapse would exceed `max_error`; without a target it goes as far as
/// that, and keeps all borders. A target that `max_error` or the topology leaves out of reach is warned of, with what
/// is left. The default of `max_error` leaves a noisy reconstruction far above a small target.
///
/// `primitives` is the region, by falling area, -1 for free triangles; classes and storeys are those of the triangles
/// that are left, colours those of the vertices. The same bytes with any number of threads. Where all triangles are
/// objects, as in a reconstruction of a whole scan, there are no classes: nobody has told structure from objects. An
/// empty mesh stays empty. Errors: neither triangles, ratio nor max_error given; a mesh with vertices that are not
/// finite or corners that do not exist.
struct PlaneQuadric {
  static constexpr std::string_view type = "baseline.plane_quadric";
  static constexpr int version = 2;
  static constexpr std::string_view summary = "Decimates a mesh plane by plane, keeping their borders (plane-opt).";
  struct In {
    Input<Mesh> mesh;
  };
  struct Out {
    Mesh mesh;
    std::int64_t planes = 0;
  };
  struct Params {
    std::int64_t triangles = 0;
    double ratio = 0;
    double max_error = 0.02;
    double distance = 0.03;
    double angle = 30;
    double min_area = 0.1;
    double border_weight = 0.1;
  };
  static constexpr auto inputs = std::tuple{port<&In::mesh>("What to simplify.")};
  static constexpr auto outputs = std::tuple{port<&Out::mesh>("The simplified mesh, in the same frame."),
                                             port<&Out::planes>("How many planar regions there are.")};
  static constexpr auto params = std::tuple{
      param<&Params::triangles>(count, within(0, 1e9), "At most so many are left. 0: no such target."),
      param<&Params::ratio>(atrium::ratio, within(0, 1),
                            "At most this share of the triangles is left. 0: no such target."),
      param<&Params::max_error>(
          metres, within(0, 10),
          "Root mean square distance of a vertex to the planes that it stands for. 0: only a target ends it."),
      param<&Params::distance>(metres, within(1e-6, 10), "Of a region's vertices to its plane, at most."),
      param<&Params::angle>(degrees, within(0, 90),
                            "Of a triangle's normal (smoothed over its neighbours) to its region's, at most."),
      param<&Params::min_area>(square_metres, within(0, 1e6), "Smaller regions are given up."),
      param<&Params::border_weight>(
          unitless, within(0, 1e6),
          "How firmly borders hold their course where the planes beside them do not tell it: borders of the mesh, of "
          "free triangles, and of parallel planes. 1: as much as the squared length of the edge in area."),
  };
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::baseline
