#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "modules/building/corrections.hpp"
#include "modules/building/opening_fitting.hpp"

namespace atrium::building {
namespace {

/// The rectangle's place along the wall: from its left or right corner to the nearer jamb.
void place_from_corner(const Correction& correction, const FaceView& view, double width, OpeningBox& box) {
  const double distance = correction.number("distance");
  const bool right = correction.has("corner") && correction.text("corner") == "right";
  box.left = right ? view.extent.right - distance - width : view.extent.left + distance;
  box.right = box.left + width;
}

void mark_opening(CorrectionDraft& draft, const BuildingOpening& opening, const std::string& what) {
  draft.mark(opening.room_a, what);
  if (opening.room_b != opening.room_a) draft.mark(opening.room_b, what);
}

std::string size_text(const OpeningBox& box) {
  return fmt::format("{:.2f} m × {:.2f} m", box.width(), box.high - box.low);
}

/// The face of an opening in the room that the correction names; it must, where there are two and the sides matter.
bool side_of(CorrectionDraft& draft, const Correction& correction, std::int32_t index) {
  const BuildingOpening& opening = draft.opening(index);
  const std::string name = draft.opening_name(index);
  const bool sided = correction.has("distance") || correction.has("by");
  if (correction.has("room")) {
    const std::int32_t room = draft.room_named(correction, "room", correction.text("room"));
    if (room == opening.room_a && opening.face_a >= 0) return true;
    if (room == opening.room_b && opening.face_b >= 0) return false;
    correction.fail("room", fmt::format("{} is in no wall of '{}'", name, draft.room(room).name));
  }
  if (sided && opening.face_a >= 0 && opening.face_b >= 0)
    correction.fail("opening", fmt::format("{} is seen from two sides, and left and right depend on the side", name),
                    "say with `room` from where its wall is seen");
  return opening.face_a >= 0;
}

void swap_sides(BuildingOpening& opening) {
  std::swap(opening.room_a, opening.room_b);
  std::swap(opening.face_a, opening.face_b);
  std::swap(opening.outline_a, opening.outline_b);
}

}  // namespace

void add_opening(CorrectionDraft& draft, const Correction& correction) {
  const std::int32_t room = draft.room_of(correction), face = draft.face_of(correction, room);
  const OpeningFitting fitting(draft, correction, face, -1);
  OpeningBox box;
  place_from_corner(correction, fitting.view(), correction.number("width"), box);
  if (correction.text("kind") == "window" && !correction.has("sill"))
    correction.fail({}, "'sill' of a window is missing", "its lower edge over the foot of the wall, as in sill: 90 cm");
  box.low = fitting.view().foot(box.left, box.right) + correction.number_or("sill", 0);
  box.high = box.low + correction.number("height");
  BuildingOpening opening = fitting.run(correction.text("kind"), box);
  opening.corrections.emplace_back("added");
  mark_opening(draft, opening,
               fmt::format("{} of {} added in {}", opening.kind, size_text(box), wall_called(draft, correction, face)));
  draft.add_opening(std::move(opening));
}

void change_opening(CorrectionDraft& draft, const Correction& correction) {
  const std::int32_t index = draft.opening_of(correction);
  const BuildingOpening before = draft.opening(index);
  const bool first = side_of(draft, correction, index);
  const std::int32_t face = first ? before.face_a : before.face_b;
  if (before.kind == "slab" || face < 0 || draft.face(face).surface != SurfaceClass::wall)
    correction.fail("opening", fmt::format("{} is in no wall", draft.opening_name(index)), "it can be dropped only");
  const OpeningFitting fitting(draft, correction, face, index);
  OpeningBox box = fitting.view().box(first ? before.outline_a : before.outline_b);
  const double width = correction.number_or("width", box.width()),
               height = correction.number_or("height", box.high - box.low);
  const double middle = 0.5 * (box.left + box.right);
  box.left = middle - 0.5 * width;
  box.right = middle + 0.5 * width;
  if (correction.has("distance") && correction.has("by"))
    correction.fail("by", "'distance' and 'by' both say where the opening is", "give one of them");
  if (correction.has("distance")) place_from_corner(correction, fitting.view(), width, box);
  const double by = correction.number_or("by", 0);
  box.left += by;
  box.right += by;
  if (correction.has("sill")) box.low = fitting.view().foot(box.left, box.right) + correction.number("sill");
  box.high = box.low + height;
  const std::string kind = correction.has("kind") ? correction.text("kind") : before.kind;
  // Where only the kind changes, the rectangles stay bit by bit.
  BuildingOpening opening = before;
  opening.kind = kind;
  const bool reshaped = correction.has("width") || correction.has("height") || correction.has("sill") || by != 0 ||
                        correction.has("distance");
  if (reshaped) {
    opening = fitting.run(kind, box);
    opening.corrections = before.corrections;
    if (!first) swap_sides(opening);
    // Without a face there is no first side.
    if (opening.face_a < 0) swap_sides(opening);
  }
  const std::string name = draft.opening_name(index);
  const std::string change = reshaped ? fmt::format("{} changed to {}", name, size_text(box)) : name + " changed";
  opening.corrections.push_back(kind == before.kind ? "changed" : fmt::format("changed, was a {}", before.kind));
  mark_opening(draft, opening, kind == before.kind ? change : fmt::format("{}, a {}", change, kind));
  if (before.room_b != opening.room_b && before.room_b != opening.room_a) draft.mark(before.room_b, change);
  draft.opening(index) = std::move(opening);
}

void drop_opening(CorrectionDraft& draft, const Correction& correction) {
  const std::int32_t index = draft.opening_of(correction);
  const std::string told = draft.opening_name(index) + " dropped";
  mark_opening(draft, draft.opening(index), told);
  for (const auto face : {draft.opening(index).face_a, draft.opening(index).face_b})
    if (face >= 0) draft.mark_face(face, told);
  draft.drop_opening(index);
}

}  // namespace atrium::building
