#pragma once
#include "graph/api/node.hpp"
#include "modules/types/building.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/mesh.hpp"
#include "modules/types/metrics.hpp"

namespace atrium::building {

/// States how far the scan's points are from the model, face by face, as a deliverable: a table, a heat map, totals.
///
/// Each point belongs to the nearest face of `mesh` (layout.mesh's structure, whose openings are cut out) that is at
/// most `reach` away, if it lies over that face and not beside it (in the reveal of a window); its signed distance is
/// that to the face's plane, positive on the room's side. Points that are further away are furniture and the like, and
/// count nowhere. So a face whose true surface is further off than `reach` shows as not covered, and distances above
/// `reach` are never measured. The points are those of `cloud`: wire the whole scan, not the points that the planes
/// were fitted to.
///
/// accuracy.csv (RFC 4180), a line per face: face (its number in building.json), class, storey, room, area_m2 (without
/// openings), points, median_mm (signed), rms_mm, p95_mm (95 % of distances are within), covered (share of its area
/// that points of its plane cover; from the building), inferred (yes or no), loa (band of USIBD's Level of Accuracy
/// Specification that p95 reaches: LOA10 above 5 cm, LOA20 to 5 cm, LOA30 to 15 mm, LOA40 to 5 mm, LOA50 to 1 mm; empty
/// under 10 points), and with `specified` also meets (yes or no; empty where loa is). LOA is stated by measuring
/// against the scan itself ("represented accuracy"): how accurate the scan is nobody can tell from it.
///
/// accuracy.svg: each face as it is seen from its room, walls side by side, storey by storey, coloured by the mean
/// signed distance of each square of `cell` (blue behind the face, red before it; grey: no points), with a scale of
/// ± `colour_range`. Where a face would have more than about a million squares, all are wider, with a warning.
///
/// heat_maps.json: the same squares for a program that paints them onto the faces (`atrium view` does):
/// {atrium_heat_maps 1, units "m", origin, cell, range, step, faces}. Per face with points: face (its number), corner
/// (its lower left one; origin + corner is in the mesh's frame), across and up (unit vectors in its plane), columns,
/// rows, and squares: row by row from the corner, the mean signed distance in steps of `step` (0.1 mm), null without
/// points.
///
/// Metrics: accuracy.{all,wall,floor,ceiling}.{points,median,rms,p95} and accuracy.area.{loa10,…,loa50,unknown}, shares
/// of the faces' area; classes without points are left out. With `specified` also accuracy.area.meets.
///
/// Errors: a mesh without the column `primitives`, or whose triangles name faces that the building has not; numbers
/// that are not finite. Without points every face is unknown, with a warning. Same bytes with any number of threads.
/// Cost: O(points · log triangles).
struct Accuracy {
  static constexpr std::string_view type = "building.accuracy";
  static constexpr std::string_view summary =
      "States per face how far the scan's points are from the model (USIBD LOA).";
  enum class Band { none, loa10, loa20, loa30, loa40, loa50 };
  struct In {
    Input<Building> building;
    Input<Mesh> mesh;
    Input<Cloud> cloud;
  };
  struct Out {
    Metrics metrics;
  };
  struct Params {
    OutputPath path{"accuracy.csv"};
    OutputPath picture{"accuracy.svg"};
    OutputPath heat_maps{"heat_maps.json"};
    double reach = 0.08;
    double cell = 0.10;
    double colour_range = 0.02;
    Band specified = Band::none;
    std::int64_t max_points = 200'000;
  };
  static constexpr auto inputs =
      std::tuple{port<&In::building>("Names, classes, storeys of the faces."),
                 port<&In::mesh>("Its surface with openings cut out, in the cloud's frame (layout.mesh)."),
                 port<&In::cloud>("The scan.")};
  static constexpr auto outputs = std::tuple{port<&Out::metrics>("accuracy.…: metres and shares.")};
  static constexpr auto params = std::tuple{
      param<&Params::path>("The table, in the run's folder."),
      param<&Params::picture>("The heat map."),
      param<&Params::heat_maps>("The heat map's squares per face, for programs."),
      param<&Params::reach>(metres, within(0.001, 1), "Points further away belong to no face."),
      param<&Params::cell>(metres, within(0.01, 10), "Edge of the heat map's squares."),
      param<&Params::colour_range>(metres, within(1e-4, 1), "Distance of the scale's ends."),
      param<&Params::specified>({{"none", Band::none},
                                 {"LOA10", Band::loa10},
                                 {"LOA20", Band::loa20},
                                 {"LOA30", Band::loa30},
                                 {"LOA40", Band::loa40},
                                 {"LOA50", Band::loa50}},
                                "The band that is asked for."),
      param<&Params::max_points>(count, within(1, 1e9),
                                 "Of a cloud with more, every n-th point is taken, so that it is at most this many.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::building
