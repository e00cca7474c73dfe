#include "modules/layout/room_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace atrium::layout {
namespace {

struct Doubt {
  double share;
  std::string reason;
};

double percent(double share) { return 100 * share; }

/// A hall whose ceiling was seen may be high; a room as high as it is wide may have been scanned in feet.
double height_share(double height, double area, double ceiling) {
  constexpr double hall = 0.45, mostly = 0.5;  // of the edge of a square of that area; of the ceiling
  if (height > 5 && height < hall * std::sqrt(area) && ceiling > mostly) return 1;
  if (height > 8) return ramp(height, 8, 15, 0.5, 0.4);
  if (height > 5) return ramp(height, 5, 8, 1, 0.5);
  return ramp(height, 1.2, 2);
}

/// Why a room of which one level was hardly seen is doubtful; empty: both were seen.
std::string unseen_level(const RoomEvidence& e) {
  constexpr double hardly = 0.2, neither = 0.1, none = 0.05;
  if (e.floor < neither && e.ceiling < neither) return "neither its floor nor its ceiling was seen";
  if (e.floor < none) return "its floor was not seen";
  if (e.ceiling < none) return "its ceiling was not seen";
  if (e.floor < hardly) return fmt::format("only {:.0f} % of its floor was seen", percent(e.floor));
  if (e.ceiling < hardly) return fmt::format("only {:.0f} % of its ceiling was seen", percent(e.ceiling));
  return {};
}

std::vector<Doubt> doubts_of(const BuildingRoom& room, const RoomEvidence& e) {
  constexpr double one_level = 0.85;
  std::vector<Doubt> doubts;
  const auto add = [&](double share, std::string reason) { doubts.push_back({share, std::move(reason)}); };
  add(ramp(e.walls, 0.08, 0.4), fmt::format("{:.0f} % of its walls were seen", percent(e.walls)));
  add(ramp(e.enclosed, 0.45, 0.8), fmt::format("walls were seen along {:.0f} % of its outline", percent(e.enclosed)));
  add(ramp(e.contact, 0.05, 0.4),
      fmt::format("{:.0f} % of its walls' length stands on a floor or reaches a ceiling", percent(e.contact)));
  const std::string unseen = unseen_level(e);
  add(ramp(std::max(e.floor, e.ceiling), 0.1, 0.5) * (unseen.empty() ? 1 : one_level),
      !unseen.empty() ? unseen
                      : fmt::format("{:.0f} % of its floor and {:.0f} % of its ceiling were seen", percent(e.floor),
                                    percent(e.ceiling)));
  add(height_share(e.headroom, room.area, e.ceiling),
      fmt::format("it is {:.2f} m high, {}", e.headroom,
                  e.headroom < 1.8 ? "too low to stand in"
                  : e.headroom < 2 ? "lower than rooms are"
                                   : "higher than rooms are: is the unit of length right?"));
  add(ramp(room.area, 0.4, 0.9), fmt::format("it has {:.2f} m2, less than a room", room.area));
  add(ramp(e.width, 0.2, 0.4), fmt::format("it is a slit, {:.2f} m wide", e.width));
  add(ramp(e.inner_walls, 0.04, 0.2, 1, 0.3),
      fmt::format("walls from floor to ceiling stand in it, {:.0f} % of its outline long", percent(e.inner_walls)));
  add(ramp(e.other_floor, 0.2, 0.6, 1, 0.3),
      fmt::format("another floor lies over {:.0f} % of its floor", percent(e.other_floor)));
  add(ramp(e.other_ceiling, 0.2, 0.6, 1, 0.3),
      fmt::format("another ceiling hangs under {:.0f} % of its ceiling", percent(e.other_ceiling)));
  add(ramp(e.open_part, 0.25, 0.5, 1, 0.7),
      fmt::format("no ceiling was seen over a part of it, {:.0f} % of its area: is that outside?",
                  percent(e.open_part)));
  add(ramp(e.open_top, 0.5, 3, 1, 0.6),
      fmt::format("{:.1f} m of its walls end below a ceiling that goes on behind them: are they fronts of cupboards?",
                  e.open_top));
  add(ramp(e.overlap, 0.1, 0.5, 1, 0.2), fmt::format("{:.0f} % of it lie in another room, too", percent(e.overlap)));
  return doubts;
}

}  // namespace

double ramp(double value, double from, double to, double low, double high) {
  return low + (high - low) * std::clamp((value - from) / (to - from), 0.0, 1.0);
}

Verdict verdict_of(const BuildingRoom& room, const RoomEvidence& evidence) {
  constexpr double worth_saying = 0.9;
  Verdict verdict;
  auto doubts = doubts_of(room, evidence);
  std::stable_sort(doubts.begin(), doubts.end(), [](const Doubt& a, const Doubt& b) { return a.share < b.share; });
  for (auto& doubt : doubts) {
    verdict.confidence *= doubt.share;
    if (doubt.share < worth_saying) verdict.doubts.push_back(std::move(doubt.reason));
  }
  return verdict;
}

}  // namespace atrium::layout
