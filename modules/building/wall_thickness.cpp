#include <fmt/format.h>

#include <algorithm>

#include "modules/building/corrections.hpp"
#include "modules/building/element_steps.hpp"

namespace atrium::building {
namespace {

/// The stretches of a face behind which no other face is, in the plan.
struct SingleStretches {
  FaceLine line;
  std::vector<Backing> spans;
  double other = 0;  ///< thickness of a wall between this face and another one; 0: there is none
};

Elements elements_now(const CorrectionDraft& draft, double assumed_thickness) {
  ElementLimits limits;
  limits.max_thickness = draft.max_thickness;
  limits.assumed_wall = assumed_thickness;
  return elements_of(draft.building, limits);
}

SingleStretches single_stretches(const Elements& elements, std::int32_t face) {
  SingleStretches result;
  for (const auto& line : elements.lines) {
    if (line.face != face) continue;
    result.line = line;
    for (const auto& part : line.backing) {
      if (part.wall < 0) continue;
      const Wall& wall = elements.walls[static_cast<std::size_t>(part.wall)];
      if (std::find(wall.faces.begin(), wall.faces.end(), face) == wall.faces.end()) continue;
      if (wall.faces.size() == 1)
        result.spans.push_back(part);
      else
        result.other = wall.thickness;
    }
  }
  return result;
}

/// A room that a wall reaches into, and how far behind the wall's face it begins, in metres.
struct RoomBehind {
  std::int32_t room = -1;  ///< -1: there is none
  double from = 0;
};

RoomBehind room_behind(const SingleStretches& stretches, const std::vector<RoomSpace>& rooms, double thickness) {
  constexpr double common_height = 0.05, crumb = 0.01;  // metres, square metres
  const FaceLine& line = stretches.line;
  const Eigen::Vector2d back = -line.normal * thickness;
  std::vector<PlanRing> strips;
  strips.reserve(stretches.spans.size());
  for (const auto& span : stretches.spans)
    strips.push_back({line.at(span.from), line.at(span.to), line.at(span.to) + back, line.at(span.from) + back});
  const Region behind = floorplan::united(strips);
  for (std::size_t r = 0; r < rooms.size(); ++r) {
    const Region shared = floorplan::common(behind, occupied(rooms[r], line.low, line.high, common_height));
    if (floorplan::area(shared) < crumb) continue;
    double from = thickness;
    for (const auto& polygon : shared)
      for (const auto& p : polygon.outline) from = std::min(from, line.offset - line.normal.dot(p));
    return {static_cast<std::int32_t>(r), from};
  }
  return {};
}

}  // namespace

void set_thickness(CorrectionDraft& draft, const Correction& correction) {
  constexpr double thinnest = 0.01;  // metres
  const std::int32_t room = draft.room_of(correction), face = draft.face_of(correction, room);
  const double thickness = correction.number("thickness");
  if (thickness < thinnest)
    correction.fail("thickness", fmt::format("{:.3f} m is no thickness of a wall", thickness), "1 cm or more");
  const SingleStretches stretches = single_stretches(elements_now(draft, thickness), face);
  if (stretches.spans.empty() && stretches.other > 0)
    correction.fail("thickness",
                    fmt::format("both faces of the wall behind {} are known: it is {:.3f} m thick",
                                draft.face_name(face), stretches.other),
                    "move_wall moves one of them");
  if (stretches.spans.empty())
    correction.fail("thickness", fmt::format("no wall is behind {}: it is a step or a column", draft.face_name(face)),
                    draft.walls_of(room));
  if (const RoomBehind behind = room_behind(stretches, spaces_of(draft.building), thickness); behind.room >= 0)
    correction.fail("thickness", fmt::format("so thick the wall would reach into '{}'", draft.room(behind.room).name),
                    fmt::format("that room begins {:.2f} m behind {}", behind.from, draft.face_name(face)));
  draft.face(face).backing = thickness;
  draft.mark_face(face, fmt::format("wall behind it set to {:.3f} m", thickness));
  draft.mark(room, fmt::format("{} set to a thickness of {:.3f} m", wall_called(draft, correction, face), thickness));
}

void check_thicknesses(CorrectionDraft& draft, const Correction& correction) {
  const auto& faces = draft.building.faces;
  if (std::none_of(faces.begin(), faces.end(), [](const BuildingFace& face) { return face.backing > 0; })) return;
  const Elements elements = elements_now(draft, ElementLimits{}.assumed_wall);
  const std::vector<RoomSpace> rooms = spaces_of(draft.building);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (!(faces[f].backing > 0)) continue;
    const auto face = static_cast<std::int32_t>(f);
    const SingleStretches stretches = single_stretches(elements, face);
    if (stretches.spans.empty()) continue;
    const RoomBehind behind = room_behind(stretches, rooms, faces[f].backing);
    if (behind.room >= 0)
      correction.fail({},
                      fmt::format("the wall behind {}, {:.3f} m thick by set_thickness, would reach into '{}'",
                                  draft.face_name(face), faces[f].backing, draft.room(behind.room).name),
                      fmt::format("that room begins {:.2f} m behind {}", behind.from, draft.face_name(face)));
  }
}

}  // namespace atrium::building
