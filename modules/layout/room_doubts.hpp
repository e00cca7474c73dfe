#pragma once
#include <string>
#include <vector>

#include "modules/layout/room_evidence.hpp"

namespace atrium::layout {

/// A number from 0 to 1 and what keeps it from being 1, the gravest first.
struct Verdict {
  double confidence = 1;
  std::vector<std::string> doubts;
};

/// The product of the shares that layout.confidence documents.
Verdict verdict_of(const BuildingRoom& room, const RoomEvidence& evidence);

/// 0 below and 1 above: a value between two limits as a share, from `low` at `from` to `high` at `to`.
double ramp(double value, double from, double to, double low = 0, double high = 1);

}  // namespace atrium::layout
