#pragma once
#include "modules/baseline/exchange.hpp"

namespace atrium::baseline {

/// The request's numbers; its points have normals that point out of what is to be solid. The reply's triangles have
/// their polygon as indices.
struct KsrSettings {
  double distance = 0, normal_angle = 0, min_points = 0, neighbours = 0;
  bool regularise = false;
  double angle_tolerance = 0, max_offset = 0;
  bool oriented_box = false;
  double crossings = 0, lambda = 0;

  void write(Exchange& request) const {
    request.numbers = {distance,
                       normal_angle,
                       min_points,
                       neighbours,
                       regularise ? 1.0 : 0.0,
                       angle_tolerance,
                       max_offset,
                       oriented_box ? 1.0 : 0.0,
                       crossings,
                       lambda};
  }
  static KsrSettings from(const Exchange& request) {
    const auto& n = request.numbers;
    return {n.at(0), n.at(1), n.at(2), n.at(3), n.at(4) != 0, n.at(5), n.at(6), n.at(7) != 0, n.at(8), n.at(9)};
  }
};

/// The reply's numbers.
struct KsrFacts {
  double planes = 0, volumes = 0;

  void write(Exchange& reply) const { reply.numbers = {planes, volumes}; }
  static KsrFacts from(const Exchange& reply) { return {reply.numbers.at(0), reply.numbers.at(1)}; }
};

}  // namespace atrium::baseline
