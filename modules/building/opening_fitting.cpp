#include "modules/building/opening_fitting.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "modules/geometry/plan_overlay.hpp"
#include "modules/types/building_rules.hpp"

namespace atrium::building {
namespace {

OpeningBox box_of(const std::vector<Eigen::Vector2d>& places) {
  OpeningBox box{1e300, -1e300, 1e300, -1e300};
  for (const auto& p : places) {
    box.left = std::min(box.left, p.x());
    box.right = std::max(box.right, p.x());
    box.low = std::min(box.low, p.y());
    box.high = std::max(box.high, p.y());
  }
  return box;
}

}  // namespace

FaceView::FaceView(const Building& of, std::int32_t face) : index(face) {
  const BuildingFace& source = of.faces[static_cast<std::size_t>(face)];
  frame = upright_frame(source.plane, of.vertices[source.outline[0]]);
  polygon = flat_polygon(of, source);
  extent = box_of(polygon.outline);
}
OpeningBox FaceView::box(const std::vector<Eigen::Vector3d>& outline) const {
  std::vector<Eigen::Vector2d> places;
  places.reserve(outline.size());
  for (const auto& p : outline) places.push_back(frame.to_plane(p));
  return box_of(places);
}
std::vector<Eigen::Vector3d> FaceView::outline(const OpeningBox& box) const {
  std::vector<Eigen::Vector3d> result;
  for (const auto& p : box.ring()) result.push_back(frame.to_space(p));
  return result;
}
bool FaceView::holds(const OpeningBox& box) const {
  constexpr double rounding = 0.0005;  // metres
  return overlay::covers(polygon, {box.ring(rounding), {}});
}
double FaceView::foot(double left, double right) const {
  const PlanRing band{
      {left, extent.low - 1}, {right, extent.low - 1}, {right, extent.high + 1}, {left, extent.high + 1}};
  double low = 1e300;
  for (const auto& part : overlay::intersection({polygon}, {band, {}})) low = std::min(low, box_of(part.outline).low);
  return low < 1e299 ? low : extent.low;
}

OpeningFitting::OpeningFitting(const CorrectionDraft& draft, const Correction& correction, std::int32_t face,
                               std::int32_t replaced)
    : draft_(draft), correction_(correction), view_(draft.building, face), replaced_(replaced) {}

const std::string& OpeningFitting::room_name(std::int32_t face_index) const {
  return draft_.building.rooms[static_cast<std::size_t>(face(face_index).room)].name;
}

BuildingOpening OpeningFitting::run(const std::string& kind, const OpeningBox& box) const {
  check_place(box);
  BuildingOpening opening;
  opening.kind = kind;
  opening.face_a = view_.index;
  opening.room_a = face(view_.index).room;
  opening.outline_a = view_.outline(box);
  if (const std::int32_t back = face_behind(kind, box); back >= 0) {
    opening.face_b = back;
    opening.room_b = face(back).room;
    opening.thickness = std::abs(face(back).plane.signed_distance(opening.outline_a[0]));
    const FaceView other(draft_.building, back);
    opening.outline_b = other.outline(box_behind(other, kind, box));
    check_overlaps(other, box_behind(other, kind, box));
  }
  return opening;
}

void OpeningFitting::check_place(const OpeningBox& box) const {
  const OpeningBox& extent = view_.extent;
  if (!view_.holds(box)) {
    const double foot = view_.foot(box.left, box.right);
    const std::string key = box.right > extent.right || box.left < extent.left ? "distance" : "height";
    correction_.fail(
        key,
        fmt::format("the opening leaves its wall, {} of '{}'", draft_.face_name(view_.index), room_name(view_.index)),
        fmt::format("it would be from {:.2f} to {:.2f} m along the wall, which is {:.2f} m long, and from "
                    "{:.2f} to {:.2f} m over its foot; the wall is {:.2f} m high",
                    box.left - extent.left, box.right - extent.left, extent.width(), box.low - foot, box.high - foot,
                    extent.high - extent.low));
  }
  check_overlaps(view_, box);
}

void OpeningFitting::check_overlaps(const FaceView& view, const OpeningBox& box) const {
  for (std::size_t o = 0; o < draft_.building.openings.size(); ++o) {
    const auto index = static_cast<std::int32_t>(o);
    const BuildingOpening& other = draft_.building.openings[o];
    if (index == replaced_) continue;
    const auto side = [&](std::int32_t pierced, const std::vector<Eigen::Vector3d>& outline) {
      if (pierced != view.index || outline.size() < 3) return;
      const OpeningBox taken = view.box(outline);
      if (taken.overlaps(box))
        correction_.fail(
            "distance", fmt::format("the opening overlaps {}", draft_.opening_name(index)),
            fmt::format("that one is from {:.2f} to {:.2f} m along {}, from its left corner",
                        taken.left - view.extent.left, taken.right - view.extent.left, draft_.face_name(view.index)));
    };
    side(other.face_a, other.outline_a);
    side(other.face_b, other.outline_b);
  }
}

/// The rectangle on the other side, where what was left is right; a door stands on that side's floor too.
OpeningBox OpeningFitting::box_behind(const FaceView& other, const std::string& kind, const OpeningBox& box) const {
  constexpr double step = 0.3;  // metres between two floors
  OpeningBox result = other.box(view_.outline(box));
  if (kind == "window") return result;
  const double foot = other.foot(result.left, result.right);
  const bool on_floor = std::abs(box.low - view_.foot(box.left, box.right)) < 0.001;
  if (on_floor && std::abs(foot - result.low) < step) result.low = foot;
  return result;
}

std::int32_t OpeningFitting::face_behind(const std::string& kind, const OpeningBox& box) const {
  const double opposite = -std::cos(wall_parallel_angle * EIGEN_PI / 180);
  const BuildingFace& front = face(view_.index);
  const Eigen::Vector3d middle = view_.frame.to_space({0.5 * (box.left + box.right), 0.5 * (box.low + box.high)});
  std::int32_t best = -1, partly = -1;
  double least = 1e300, shared = 0;
  for (std::size_t f = 0; f < draft_.building.faces.size(); ++f) {
    const BuildingFace& behind_face = draft_.building.faces[f];
    if (behind_face.room < 0 || behind_face.plane.normal.dot(front.plane.normal) > opposite) continue;
    const double away = -behind_face.plane.signed_distance(middle);
    if (away < -0.001 || away > draft_.max_thickness || away >= least) continue;
    const FaceView other(draft_.building, static_cast<std::int32_t>(f));
    const OpeningBox behind = box_behind(other, kind, box);
    const double common = overlay::area(overlay::intersection({other.polygon}, {behind.ring(), {}}));
    if (other.holds(behind)) {
      best = static_cast<std::int32_t>(f);
      least = away;
    } else if (common > shared) {
      partly = static_cast<std::int32_t>(f);
      shared = common;
    }
  }
  constexpr double crumb = 0.01;  // square metres
  if (best < 0 && shared > crumb) {
    const FaceView other(draft_.building, partly);
    const OpeningBox far = view_.box(other.outline(other.extent));
    correction_.fail(
        "distance",
        fmt::format("the opening lies only partly before {} of '{}'", draft_.face_name(partly), room_name(partly)),
        fmt::format("that wall is behind from {:.2f} to {:.2f} m along this one, and up to {:.2f} m over its foot",
                    far.left - view_.extent.left, far.right - view_.extent.left, far.high - view_.extent.low));
  }
  return best;
}

}  // namespace atrium::building
