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

SingleStretches single_stretches(const CorrectionDraft& draft, std::int32_t face, double thickness) {
  ElementLimits limits;
  limits.max_thickness = draft.max_thickness;
  limits.assumed_wall = thickness;
  const Elements elements = elements_of(draft.building, limits);
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

/// Throws if the wall would be where a room is, and says from where on.
void check_rooms_behind(const CorrectionDraft& draft, const Correction& correction, const SingleStretches& stretches,
                        double thickness) {
  constexpr double common_height = 0.05, crumb = 0.01;  // metres, square metres
  const FaceLine& line = stretches.line;
  const Eigen::Vector2d back = -line.normal * thickness;
  std::vector<PlanRing> strips;
  strips.reserve(stretches.spans.size());
  for (const auto& span : stretches.spans)
    strips.push_back({line.at(span.from), line.at(span.to), line.at(span.to) + back, line.at(span.from) + back});
  const Region behind = floorplan::united(strips);
  const std::vector<RoomSpace> rooms = spaces_of(draft.building);
  for (std::size_t r = 0; r < rooms.size(); ++r) {
    const Region shared = floorplan::common(behind, occupied(rooms[r], line.low, line.high, common_height));
    if (floorplan::area(shared) < crumb) continue;
    double from = thickness;
    for (const auto& polygon : shared)
      for (const auto& p : polygon.outline) from = std::min(from, line.offset - line.normal.dot(p));
    correction.fail("thickness", fmt::format("so thick the wall would reach into '{}'", draft.building.rooms[r].name),
                    fmt::format("that room begins {:.2f} m behind {}", from, draft.face_name(line.face)));
  }
}

}  // namespace

void set_thickness(CorrectionDraft& draft, const Correction& correction) {
  constexpr double thinnest = 0.01;  // metres
  const std::int32_t room = draft.room_of(correction), face = draft.face_of(correction, room);
  const double thickness = correction.number("thickness");
  if (thickness < thinnest)
    correction.fail("thickness", fmt::format("{:.3f} m is no thickness of a wall", thickness), "1 cm or more");
  const SingleStretches stretches = single_stretches(draft, face, thickness);
  if (stretches.spans.empty() && stretches.other > 0)
    correction.fail("thickness",
                    fmt::format("both faces of the wall behind {} are known: it is {:.3f} m thick",
                                draft.face_name(face), stretches.other),
                    "move_wall moves one of them");
  if (stretches.spans.empty())
    correction.fail("thickness", fmt::format("no wall is behind {}: it is a step or a column", draft.face_name(face)),
                    draft.walls_of(room));
  check_rooms_behind(draft, correction, stretches, thickness);
  draft.face(face).backing = thickness;
  draft.mark_face(face, fmt::format("wall behind it set to {:.3f} m", thickness));
  draft.mark(room, fmt::format("{} set to a thickness of {:.3f} m", wall_called(draft, correction, face), thickness));
}

}  // namespace atrium::building
