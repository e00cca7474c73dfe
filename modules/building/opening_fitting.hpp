#pragma once
#include <algorithm>

#include "modules/building/correction_draft.hpp"
#include "modules/geometry/plane_frame.hpp"

namespace atrium::building {

/// An opening's rectangle in the frame of its face: x to the right as seen from the room, y upwards.
struct OpeningBox {
  double left = 0, right = 0, low = 0, high = 0;
  double width() const { return right - left; }
  PlanRing ring(double slack = 0) const {
    return {{left + slack, low + slack},
            {right - slack, low + slack},
            {right - slack, high - slack},
            {left + slack, high - slack}};
  }
  bool overlaps(const OpeningBox& other) const {
    constexpr double touch = 0.001;  // metres
    return std::min(right, other.right) - std::max(left, other.left) > touch &&
           std::min(high, other.high) - std::max(low, other.low) > touch;
  }
};

/// A face seen from its room.
struct FaceView {
  std::int32_t index = -1;
  PlaneFrame frame;
  PlanPolygon polygon;
  OpeningBox extent;

  FaceView(const Building& building, std::int32_t face);
  OpeningBox box(const std::vector<Eigen::Vector3d>& outline) const;
  std::vector<Eigen::Vector3d> outline(const OpeningBox& box) const;
  bool holds(const OpeningBox& box) const;
  /// The foot of the wall between two places along it; its least height where nothing stands there.
  double foot(double left, double right) const;
};

/// Builds an opening into a face and into what stands behind it. Throws the correction's Error where it leaves its
/// wall, overlaps another opening, or has another room behind only a part of it.
class OpeningFitting {
 public:
  /// `replaced`: the opening that is changed; -1: a new one.
  OpeningFitting(const CorrectionDraft& draft, const Correction& correction, std::int32_t face, std::int32_t replaced);
  const FaceView& view() const { return view_; }
  BuildingOpening run(const std::string& kind, const OpeningBox& box) const;

 private:
  const BuildingFace& face(std::int32_t index) const { return draft_.building.faces[static_cast<std::size_t>(index)]; }
  const std::string& room_name(std::int32_t face_index) const;
  void check_place(const OpeningBox& box) const;
  void check_overlaps(const FaceView& view, const OpeningBox& box) const;
  OpeningBox box_behind(const FaceView& other, const std::string& kind, const OpeningBox& box) const;
  std::int32_t face_behind(const std::string& kind, const OpeningBox& box) const;

  const CorrectionDraft& draft_;
  const Correction& correction_;
  FaceView view_;
  std::int32_t replaced_;
};

}  // namespace atrium::building
