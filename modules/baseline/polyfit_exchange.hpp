#pragma once
#include "modules/baseline/exchange.hpp"

namespace atrium::baseline {

/// The request's numbers; its points have normals and, as indices, their primitive. The reply's triangles have regions
/// as indices: the connected pieces of one plane.
struct PolyfitSettings {
  double fitting = 0, coverage = 0, complexity = 0;
  double time_limit = 0;      ///< as the user set it
  double solver_seconds = 0;  ///< from the start of the helper until the solver has to end
  bool accept_unproven = false;

  void write(Exchange& request) const {
    request.numbers = {fitting, coverage, complexity, time_limit, solver_seconds, accept_unproven ? 1.0 : 0.0};
  }
  static PolyfitSettings from(const Exchange& request) {
    const auto& n = request.numbers;
    return {n.at(0), n.at(1), n.at(2), n.at(3), n.at(4), n.at(5) != 0};
  }
};

/// The reply's numbers.
struct PolyfitFacts {
  double candidates = 0, variables = 0, constraints = 0;
  bool proven = false;
  double objective = 0, bound = 0;

  void write(Exchange& reply) const {
    reply.numbers = {candidates, variables, constraints, proven ? 1.0 : 0.0, objective, bound};
  }
  static PolyfitFacts from(const Exchange& reply) {
    const auto& n = reply.numbers;
    return {n.at(0), n.at(1), n.at(2), n.at(3) != 0, n.at(4), n.at(5)};
  }
};

}  // namespace atrium::baseline
