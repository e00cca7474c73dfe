#include "modules/layout/confidence.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "graph/api/text.hpp"
#include "modules/layout/ceilings_behind.hpp"
#include "modules/layout/covered_floor.hpp"
#include "modules/layout/doubled_walls.hpp"
#include "modules/layout/floor_beyond.hpp"
#include "modules/layout/kept_rooms.hpp"
#include "modules/layout/mirror_images.hpp"
#include "modules/layout/room_doubts.hpp"
#include "modules/layout/second_opinion.hpp"
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

/// Rooms into which no door, passage or hole in a slab leads.
std::vector<std::string> rooms_without_a_way(const Building& building) {
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

/// How many doors and passages lead to what is in no room.
std::size_t ways_out(const Building& building) {
  return static_cast<std::size_t>(
      std::count_if(building.openings.begin(), building.openings.end(), [](const BuildingOpening& opening) {
        return (opening.kind == "door" || opening.kind == "passage") && (opening.room_a < 0 || opening.room_b < 0);
      }));
}

/// Floor in no room: under a ceiling, or between walls beside the rooms.
void judge_missing_floor(const PlanePrimitives& planes, const Frame& frame, Building& building) {
  const CoveredFloor covered = covered_floor_without_room(building, planes);
  const FloorBeyond beyond = floor_beyond_rooms(building, planes);
  const std::size_t ways = ways_out(building);
  if (covered.missing > 0)
    building.doubts.push_back(fmt::format("{:.1f} m2 of floor under a ceiling are in no room (the largest piece {})",
                                          covered.missing, frame.place(covered.where)));
  else if (beyond.area > 0)
    building.doubts.push_back(fmt::format(
        "{:.1f} m2 of floor between walls are in no room (the largest piece, {:.1f} "
        "m2, {}): rooms, parts of them or a terrace, seen through openings only; doors that lead out of the model: {}",
        beyond.area, beyond.largest, frame.place(beyond.where), ways));
  const double area = area_of(building);
  building.confidence *= std::min(ramp(area / (area + covered.missing), 0.3, 0.9, 0.3, 1),
                                  ramp(area / (area + beyond.area), 0.3, 0.9, 0.8, 1));
  // One way out is the entrance; behind more of them are rooms of which little was seen.
  if (beyond.area > 0 && ways > 1) {
    const auto rooms = static_cast<double>(building.rooms.size());
    building.confidence *= ramp(rooms / (rooms + static_cast<double>(ways - 1)), 0.3, 0.9, 0.6, 1);
  }
}

/// How far apart the points of the building's faces are, metres.
double spacing_of(const Building& building, const PlanePrimitives& planes) {
  std::vector<bool> used(planes.primitives.size(), false);
  double area = 0;
  for (const auto& face : building.faces) {
    if (face.primitive < 0 || static_cast<std::size_t>(face.primitive) >= used.size()) continue;
    used[static_cast<std::size_t>(face.primitive)] = true;
    area += face.observed * area_of(building, face);
  }
  double points = 0;
  for (std::size_t p = 0; p < used.size(); ++p)
    if (used[p]) points += static_cast<double>(planes.primitives[p].inliers.size());
  return points > 0 ? std::sqrt(area / points) : 0;
}

/// What points far apart cannot show is missing or in the wrong place: leaves, jambs, furniture beside walls, low
/// steps.
void judge_spacing(const PlanePrimitives& planes, Building& building) {
  constexpr double sparse = 0.08, far = 0.2;  // metres
  const double spacing = spacing_of(building, planes);
  if (spacing < sparse) return;
  building.confidence *= ramp(spacing, sparse, far, 0.9, 0.4);
  building.doubts.push_back(fmt::format(
      "the points are {:.0f} cm apart: doors, windows, cupboards and what is thinner than {:.0f} cm cannot be "
      "told apart surely",
      100 * spacing, 300 * spacing));
}

/// A scan whose parts do not fit together shows its walls twice.
void judge_doubled(const DoubledWalls& doubled, Building& building) {
  constexpr double least = 0.15, most = 0.6;  // share of the walls
  if (doubled.share < least) return;
  building.confidence *= ramp(doubled.share, least, most, 0.7, 0.4);
  building.doubts.push_back(fmt::format(
      "{:.0f} % of the walls were seen twice, {:.0f} cm apart and turned by {:.1f} degrees: the scan seems to "
      "be made of parts that do not fit together",
      100 * doubled.share, 100 * doubled.apart, doubled.turned));
}

/// Judges the building by its rooms and by what they leave out.
void judge(const PlanePrimitives& planes, const DoubledWalls& doubled, const Frame& frame, Building& building) {
  building.confidence = mean_confidence(building);
  // A model on its side is wrong in all: the probability of the axis is a factor.
  constexpr double certain = 0.9;
  building.confidence *= std::clamp(frame.back.upright, 0.0, 1.0);
  if (const double upright = frame.back.upright; upright < certain) {
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
  judge_spacing(planes, building);
  judge_doubled(doubled, building);
}

/// The image of a room in a mirror is no room.
void judge_mirror_images(const PlanePrimitives& planes, Building& building) {
  constexpr double unlikely = 0.3;
  for (const MirrorImage& image : mirror_images(building, planes)) {
    BuildingRoom& room = building.rooms[image.room];
    room.confidence *= unlikely;
    room.doubts.insert(
        room.doubts.begin(),
        fmt::format("{:.0f} % of what stands in it stands in {}, too, mirrored at a wall: is it the image "
                    "in a mirror or a window?",
                    100 * image.share, building.rooms[image.of].name));
  }
}

/// Where the rooms are others if they are found in another way, one of both is wrong. Without second rooms nothing is
/// said.
void judge_second(const Building& second, Building& building) {
  constexpr double least = 0.5, enough = 0.8, unlikely = 0.6, worth_a_word = 0.9;
  if (second.rooms.empty()) return;
  const std::vector<SecondOpinion> opinions = second_opinions(building, second);
  for (std::size_t r = 0; r < building.rooms.size(); ++r) {
    const SecondOpinion& opinion = opinions[r];
    const double share = ramp(opinion.shared, least, enough, unlikely, 1);
    BuildingRoom& room = building.rooms[r];
    room.confidence *= share;
    if (share >= worth_a_word) continue;
    room.doubts.insert(
        room.doubts.begin(),
        opinion.area <= 0 ? "found in another way, there is no room here"
        : opinion.parts > 1
            ? fmt::format("found in another way, it is {} rooms, the best of {:.1f} m2", opinion.parts, opinion.area)
            : fmt::format("found in another way, the room here has {:.1f} m2", opinion.area));
  }
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
  for (std::size_t r = 0; r < building.rooms.size(); ++r) {
    Verdict verdict = verdict_of(building.rooms[r], evidence[r]);
    building.rooms[r].confidence = verdict.confidence;
    building.rooms[r].doubts = std::move(verdict.doubts);
  }
  judge_mirror_images(planes, building);
  if (in.second) judge_second(with_origin(*in.second, planes.cloud->origin), building);
  std::vector<bool> kept;
  std::size_t best = 0;
  for (std::size_t r = 0; r < building.rooms.size(); ++r) {
    kept.push_back(building.rooms[r].confidence >= params.min_confidence);
    if (building.rooms[r].confidence > building.rooms[best].confidence) best = r;
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
  judge(planes, doubled_walls(planes, walls, context), frame, building);
  if (building.confidence < params.min_confidence)
    refuse(fmt::format("the rooms found have confidence {:.2f}: {}", building.confidence,
                       building.doubts.empty() ? listed(building.rooms[0].doubts, 3) : building.doubts[0]));
  warn(building, frame, params.doubtful, context);
  context.info(fmt::format("{} of {}, {:.1f} m2, confidence {:.2f}", building.rooms.size(),
                           counted(kept.size(), "room"), area_of(building), building.confidence));
  return {with_origin(std::move(building), in.building->origin)};
}

}  // namespace atrium::layout
