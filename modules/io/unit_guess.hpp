#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "graph/api/context.hpp"

namespace atrium::io {

/// The unit that a scan's coordinates are probably in.
struct UnitGuess {
  double metres = 1;    ///< per unit
  std::string reason;   ///< what speaks for metres, for the log; may be empty
  std::string warning;  ///< the unit is not metres, or in doubt; with the setting that forces it
};

/// Weighs metres, centimetres, millimetres, inches and feet by what the scan would then show (upright_candidates) and
/// by how often files are in them. Cheap (a few milliseconds) where rooms of usual height in metres are plain to see;
/// else up to a second.
UnitGuess guess_unit(const std::vector<Eigen::Vector3f>& points, bool y_up, const Context& context);

}  // namespace atrium::io
