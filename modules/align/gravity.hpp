#pragma once
#include "graph/api/node.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::align {

/// Finds out which way is up and turns the scene until z is.
///
/// Which way: both directions of every axis that many surfaces are level or upright to are candidates. Each is given
/// the sum of logarithms of likelihood ratios: are the clear heights and widths those of rooms, do free level surfaces
/// lie at the height of seats, tables and worktops, do walls begin at the height of a door, does what is on no plane
/// lie low, does clutter stand on it, is what is level wide and in few heights, does nothing lie askew. The sum counts
/// 0.7, since these depend on one another. To these comes what files usually are: z up within 15 degrees (87 %), else y
/// (9 %), −y as cameras have it (1.5 %), −z, x and −x; with habit: y, y 60 % and z 36 %; any other direction 0.2 %. The
/// largest sum wins. On which side surfaces were seen is not used: it need not be known yet.
///
/// Tilt: an M-estimate over level planes and walls by area (refined_vertical): slopes and leaning walls have no say.
///
/// Rotates about the frame's zero; coordinates near zero stay there, since a value's origin moves and its local
/// coordinates only turn.
///
/// Warnings: a turn by more than 5 degrees or another axis than z, with what forces it; evidence that leaves two axes
/// about equally likely. The transform says how likely the choice is (Transform::upright). Errors: an `up` without
/// direction; no plane at all.
struct Gravity {
  static constexpr std::string_view type = "align.gravity";
  static constexpr std::string_view summary = "Finds out which way is up, and turns the scene upright.";
  enum class Habit { automatic, z, y };
  struct In {
    Input<PlanePrimitives> planes;
    OptionalInput<Transform> transform;
  };
  struct Out {
    PlanePrimitives planes;
    Transform transform;
  };
  struct Params {
    std::vector<double> up{0, 0, 0};
    Habit habit = Habit::automatic;
    double prior = 1.0;
  };
  static constexpr auto inputs =
      std::tuple{port<&In::planes>("Primitives and the whole cloud they lie in, in metres."),
                 port<&In::transform>("What earlier alignments did to them: input frame to their frame.")};
  static constexpr auto outputs = std::tuple{port<&Out::planes>("The primitives and their cloud, z up."),
                                             port<&Out::transform>("From the input frame to that of `planes`.")};
  static constexpr auto params = std::tuple{
      param<&Params::up>(
          unitless, unbounded,
          "What points roughly upwards in the input's frame, of any length: then only the tilt (15 degrees at most) is "
          "found. [0, 0, 0]: find out. [0, 0, 1]: z, as most scanners write; [0, 1, 0]: y, as phones, headsets and "
          "game engines do; [0, -1, 0]: a depth camera."),
      param<&Params::habit>(
          {{"auto", Habit::automatic}, {"z", Habit::z}, {"y", Habit::y}},
          "What files of this kind usually have up, where the scan does not tell: z, or y. auto: as the cloud says "
          "whose file it is (y for OBJ and glTF, else z)."),
      param<&Params::prior>(unitless, within(0.0, 10.0),
                            "Weight of what files usually are, against what the scan shows. 0: only the scan counts.")};
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::align
