#include "modules/layout/confidence.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "modules/layout/ceilings_behind.hpp"
#include "modules/layout/covered_floor.hpp"
#include "modules/layout/floor_beyond.hpp"
#include "modules/layout/kept_rooms.hpp"
#include "modules/layout/room_doubts.hpp"
#include "modules/layout/slopes_left_out.hpp"
#include "modules/types/building_rules.hpp"

namespace atrium::layout {
namespace {

std::string listed(const std::vector<std::string>& reasons, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < std::min(most, reasons.size()); ++i) text += (i > 0 ? "; " : "") + reasons[i];
  return text;
}

/// Places of the building as the user knows them.
struct Frame {
  Transform back;
  Eigen::Vector3d origin;

  std::string place(const Eigen::Vector3d& local) const {
    const Eigen::Vector3d p = back.rotation * (origin + local) + back.translation;
    return fmt::format("around x {:.1f}, y {:.1f}, z {:.1f}", p.x(), p.y(), p.z());
  }
  /// "room 3 (12.3 m2 around x 4.1, y 7.0, z 0.0)"
  std::string room(const BuildingRoom& room) const {
    Eigen::AlignedBox3d box;
    for (const auto& p : room.outline) box.extend(p);
    return fmt::format("{} ({:.1f} m2 {})", room.name, room.area,
                       place(box.isEmpty() ? Eigen::Vector3d::Zero().eval() : box.center()));
  }
};

/// The mean of the rooms, by area.
double mean_confidence(const Building& building) {
  double area = 0, sum = 0;
  for (const auto& room : building.rooms) {
    area += room.area;
    sum += room.area * room.confidence;
  }
  return area > 0 ? sum / area : 0;
}

double area_of(const Building& building) {
  double area = 0;
  for (const auto& room : building.rooms) area += room.area;
  return area;
}

/// Rooms into which no door, passage or hole in a slab leads, where there are others; empty if nobody has looked for
/// openings and walls.
std::vector<std::string> rooms_without_a_way(const Building& building) {
  if ((building.openings.empty() && building.walls.empty()) || building.rooms.size() < 2) return {};
  std::vector<bool> open(building.rooms.size(), false);
  for (const auto& opening : building.openings) {
    if (opening.kind == "window") continue;
    for (const auto room : {opening.room_a, opening.room_b})
      if (room >= 0) open[static_cast<std::size_t>(room)] = true;
  }
  std::vector<std::string> names;
  for (std::size_t r = 0; r < open.size(); ++r)
    if (!open[r]) names.push_back(building.rooms[r].name);
  return names;
}

/// Floor in no room: under a ceiling, or between walls beside the rooms.
void judge_missing_floor(const PlanePrimitives& planes, const Frame& frame, Building& building) {
  const CoveredFloor covered = covered_floor_without_room(building, planes);
  const FloorBeyond beyond = floor_beyond_rooms(building, planes);
  if (covered.missing > 0)
    building.doubts.push_back(fmt::format("{:.1f} m2 of floor under a ceiling are in no room (the largest piece {})",
                                          covered.missing, frame.place(covered.where)));
  else if (beyond.area > 0)
    building.doubts.push_back(
        fmt::format("{:.1f} m2 of floor between walls are in no room (the largest piece, {:.1f} "
                    "m2, {}): rooms, parts of them or a terrace, seen through openings only",
                    beyond.area, beyond.largest, frame.place(beyond.where)));
  const double area = area_of(building);
  building.confidence *= std::min(ramp(area / (area + covered.missing), 0.3, 0.9, 0.3, 1),
                                  ramp(area / (area + beyond.area), 0.3, 0.9, 0.8, 1));
}

/// Judges the building by its rooms and by what they leave out.
void judge(const PlanePrimitives& planes, const Frame& frame, Building& building) {
  building.confidence = mean_confidence(building);
  constexpr double certain = 0.9;
  if (const double upright = frame.back.upright; upright < certain) {
    building.confidence *= ramp(upright, 0.4, certain, 0.5, 1);
    building.doubts.push_back(
        fmt::format("which way is up is not certain ({:.0f} %): align.gravity names the other way", 100 * upright));
  }
  if (const SlopesLeftOut slopes = slopes_left_out(building, planes); slopes.area > 0) {
    building.confidence *= ramp(slopes.area / area_of(building), 0.05, 0.5, 1, 0.4);
    building.doubts.push_back(
        fmt::format("{:.1f} m2 of sloping surfaces are no part of the model, such as leaning walls or vaults (the "
                    "largest, {:.1f} m2, {})",
                    slopes.area, slopes.largest, frame.place(slopes.where)));
  }
  if (const auto closed = rooms_without_a_way(building); !closed.empty())
    building.doubts.push_back(fmt::format("no door or passage was found into {} of {} rooms ({}{})", closed.size(),
                                          building.rooms.size(), listed(closed, 5), closed.size() > 5 ? "; …" : ""));
  judge_missing_floor(planes, frame, building);
}

[[noreturn]] void refuse(const std::string& why) {
  throw Error("the scan shows no room: " + why,
              "scan the floor or the ceiling and most of the walls around it; check that z points up and the lengths "
              "are metres; layout.confidence can ask for less (`min_confidence`)");
}

void warn(const Building& building, const Frame& frame, double doubtful, Context& context) {
  for (const auto& doubt : building.doubts) context.warn(doubt);
  for (const auto& room : building.rooms)
    if (room.confidence < doubtful)
      context.warn(fmt::format("{} is doubtful, confidence {:.2f}: {}", frame.room(room), room.confidence,
                               listed(room.doubts, 3)));
  if (building.confidence < doubtful)
    context.warn(fmt::format("the building is doubtful, confidence {:.2f}: compare it with the scan before it is used",
                             building.confidence));
}

}  // namespace

Confidence::Out Confidence::run(const In& in, const Params& params, Context& context) {
  check(*in.building);
  const PlanePrimitives& planes = *in.structure->primitives;
  Building building = with_origin(*in.building, planes.cloud->origin);
  building.doubts.clear();
  const Frame frame{in.transform ? inverse(*in.transform) : Transform{}, building.origin};
  constexpr double column = 0.05;  // metres
  std::vector<Footprint> walls = footprints(planes, column, context);
  find_open_tops(planes, walls, context);
  const auto evidence = room_evidence(building, planes, face_grids(building, planes, context), walls);
  std::vector<bool> kept;
  std::size_t best = 0;
  for (std::size_t r = 0; r < building.rooms.size(); ++r) {
    BuildingRoom& room = building.rooms[r];
    Verdict verdict = verdict_of(room, evidence[r]);
    room.confidence = verdict.confidence;
    room.doubts = std::move(verdict.doubts);
    kept.push_back(room.confidence >= params.min_confidence);
    if (room.confidence > building.rooms[best].confidence) best = r;
  }
  if (building.rooms.empty()) refuse("the building has none");
  if (std::find(kept.begin(), kept.end(), true) == kept.end())
    refuse(fmt::format("of {} that may be one, the best is {} with confidence {:.2f}: {}", kept.size(),
                       frame.room(building.rooms[best]), building.rooms[best].confidence,
                       listed(building.rooms[best].doubts, 3)));
  for (std::size_t r = 0; r < kept.size(); ++r)
    if (!kept[r])
      context.warn(fmt::format("{} is left out, confidence {:.2f}: {}", frame.room(building.rooms[r]),
                               building.rooms[r].confidence, listed(building.rooms[r].doubts, 3)));
  building = with_rooms(building, kept);
  judge(planes, frame, building);
  if (building.confidence < params.min_confidence)
    refuse(fmt::format("the rooms found have confidence {:.2f}: {}", building.confidence,
                       building.doubts.empty() ? listed(building.rooms[0].doubts, 3) : building.doubts[0]));
  warn(building, frame, params.doubtful, context);
  context.info(fmt::format("{} rooms of {}, {:.1f} m2, confidence {:.2f}", building.rooms.size(), kept.size(),
                           area_of(building), building.confidence));
  return {with_origin(std::move(building), in.building->origin)};
}

}  // namespace atrium::layout
