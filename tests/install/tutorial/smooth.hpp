#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::mine {

/// Moves points onto the surface around them by moving least squares (pcl::MovingLeastSquares; Alexa et al. 2003).
/// Points keep their order and columns and get normals; those with fewer than three others within `radius` are left
/// out.
struct Smooth {
  static constexpr std::string_view type = "mine.smooth";
  static constexpr std::string_view summary = "Moves points onto the surface around them.";
  struct In {
    Input<Cloud> cloud;
  };
  struct Out {
    Cloud cloud;
  };
  struct Params {
    double radius = 0.1;
    int order = 2;
  };
  static constexpr auto inputs = std::tuple{port<&In::cloud>("Points with any columns.")};
  static constexpr auto outputs = std::tuple{port<&Out::cloud>("The points, moved, with normals.")};
  static constexpr auto params =
      std::tuple{param<&Params::radius>(metres, within(0.001, 10), "Points this near are around a point."),
                 param<&Params::order>(count, within(0, 5), "Of the polynomial that is fitted; 0 and 1: a plane.")};
  static Out run(const In& in, const Params& params);
};

}  // namespace atrium::mine
