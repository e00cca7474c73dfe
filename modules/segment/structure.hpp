#pragma once
#include "graph/api/node.hpp"
#include "modules/types/metrics.hpp"
#include "modules/types/structure.hpp"

namespace atrium::segment {

/// How up-facing and down-facing planes are told apart.
enum class Sides { normals, position };

/// What decides over floors and ceilings where there are several storeys: ten percent and equation 1, or ten percent
/// alone.
enum class StoreyRule { both, share };

/// Which height of a ceiling equation 1 compares with the main ceiling's mean height.
enum class CeilingHeight { top, mean };

/// Tells walls, floors and ceilings from everything else (paper, "Segmentation").
///
/// - Horizontal planes are those whose normal is within `horizontal_angle` of the vertical. Up-facing ones can be
///   floors, down-facing ones ceilings. The largest of each (by the product of its number of points and the volume of
///   its bounding box) is the main one.
/// - Several floors and ceilings (equation 1): a ceiling's height h, measured upwards from the main floor, is at
///   least ceiling_share of the main ceiling's; a floor's depth, measured downwards from the main ceiling, is at
///   least floor_share of the main floor's. So moving the scene changes nothing. If one of the two is missing, the
///   ends of the walls stand for it. If both are less than min_storey_height apart, the smaller one is furniture.
///   A ceiling counts by its highest point (a slanted one reaches as high as a level one), or by its mean.
/// - Several storeys: among the planes with at least storey_share of the points of the largest horizontal plane, a
///   floor above a ceiling begins a new storey, if there is room to stand below the ceiling and a ceiling or wall
///   above the floor. Then only those planes count, and equation 1 holds within each storey; or, with storey_rule:
///   share, all of them are floors and ceilings.
/// - Walls: the normal is further than wall_angle from the vertical, and the points reach over more than
///   min_wall_height. A wall belongs to the storey that it overlaps most.
/// - Planes between the two angles are lost, and counted in the report. Raise slanted_ceiling_angle for attics
///   (down-facing planes that reach as high as ceilings), lower wall_angle for slanted walls.
///
/// - There is a room if walls stand on floors or reach up to ceilings: at least min_wall_contact of the walls' length
///   has a floor within contact_distance of its foot or a ceiling as near to its head, by bounding rectangles. Measured
///   on real scans with 0.5 m: 0.48 to 1 in rooms, however partly seen; 0 in furniture without its room.
///
/// Errors: no wall; neither floor nor ceiling; walls that meet neither; overlapping angles. Only one of floor and
/// ceiling: a warning.
struct Structure {
  static constexpr std::string_view type = "segment.structure";
  static constexpr std::string_view summary = "Tells walls, floors and ceilings from objects, storey by storey.";
  struct In {
    Input<PlanePrimitives> planes;
  };
  struct Out {
    atrium::Structure structure;
    Cloud objects;
    Metrics report;
  };
  struct Params {
    double horizontal_angle = 20;
    double slanted_ceiling_angle = 20;
    double wall_angle = 85;
    double min_wall_height = 1.5;
    double ceiling_share = 0.7;
    double floor_share = 0.9;
    double storey_share = 0.10;
    double min_storey_height = 1.5;
    double min_wall_contact = 0.2;
    double contact_distance = 0.5;
    StoreyRule storey_rule = StoreyRule::both;
    CeilingHeight ceiling_height = CeilingHeight::top;
    Sides sides = Sides::normals;
  };
  static constexpr auto inputs = std::tuple{port<&In::planes>("Primitives, z up.")};
  static constexpr auto outputs =
      std::tuple{port<&Out::structure>("The primitives with class and storey."),
                 port<&Out::objects>("The points of no structural primitive, in the order of the cloud."),
                 port<&Out::report>("How many planes, walls, floors, ceilings, storeys, planes between the angle "
                                    "limits, and object points.")};
  static constexpr auto params = std::tuple{
      param<&Params::horizontal_angle>(
          degrees, within(0, 90),
          "A plane is horizontal if its normal is less than this from the vertical (paper: θ(n, z) < 20 degrees)."),
      param<&Params::slanted_ceiling_angle>(
          degrees, within(0, 90),
          "A down-facing plane is a slanted ceiling if its normal is less than this from the vertical (paper: θ ≥ 20 "
          "degrees "
          "is a hyperparameter); not above horizontal_angle: no slanted ceilings. 60 degrees suits attics."),
      param<&Params::wall_angle>(
          degrees, within(0, 90),
          "A plane can be a wall if its normal is further than this from the vertical (paper: θ(n, z) > 85 degrees)."),
      param<&Params::min_wall_height>(metres, within(0, 100),
                                      "A wall's points reach over more than this vertically (paper: h > 1.5 m)."),
      param<&Params::ceiling_share>(
          ratio, within(0, 1),
          "Least height of a ceiling over the main floor, as a share of the main ceiling's (paper: 0.7 h_max)."),
      param<&Params::floor_share>(
          ratio, within(0, 1),
          "Least depth of a floor under the main ceiling, as a share of the main floor's (paper: 0.9 h_max)."),
      param<&Params::storey_share>(
          ratio, within(0, 1),
          "In scenes of several storeys, least number of points of a floor or ceiling as a share of those of the "
          "largest "
          "horizontal plane (paper: 10 %)."),
      param<&Params::min_storey_height>(
          metres, within(0, 100),
          "A floor and a ceiling nearer to each other than this do not belong to one room; not in the paper."),
      param<&Params::min_wall_contact>(
          ratio, within(0, 1),
          "Least share of the walls' length that stands on a floor or reaches a ceiling, for there to be a room; not "
          "in the paper."),
      param<&Params::contact_distance>(
          metres, within(0, 10),
          "How near a floor is to a wall's foot, or a ceiling to its head, for min_wall_contact; the paper's th_sep."),
      param<&Params::storey_rule>(
          {{"both", StoreyRule::both}, {"share", StoreyRule::share}},
          "In scenes of several storeys: storey_share and then ceiling_share and floor_share within each storey, or "
          "storey_share alone (the paper has the one after the other and does not say whether both hold)."),
      param<&Params::ceiling_height>({{"top", CeilingHeight::top}, {"mean", CeilingHeight::mean}},
                                     "The height of a ceiling that ceiling_share and min_storey_height judge: its "
                                     "highest point, or the mean of its "
                                     "points (the paper says height). The main ceiling's is its mean."),
      param<&Params::sides>(
          {{"normals", Sides::normals}, {"position", Sides::position}},
          "normals: the planes' normals tell floors (up) from ceilings (down); position: the upper half of the "
          "horizontal "
          "planes are ceilings, for primitives without usable normals in scenes of one storey.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::segment
