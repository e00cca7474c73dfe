#pragma once
#include <string>
#include <vector>

#include "modules/floorplan/dxf_frame.hpp"

namespace atrium::floorplan {

/// Collects the entities of a drawing and makes a DXF file of release 2000 (AC1015, text) of them: metres, in the model
/// space, z = 0. Places are relative to `origin`; the file opens with `view` in sight. All methods throw Error for a
/// coordinate that is not finite.
class DxfDrawing {
 public:
  DxfDrawing(Eigen::Vector2d origin, std::vector<DxfLayer> layers, const Bounds2& view);

  void line(const std::string& layer, const Eigen::Vector2d& a, const Eigen::Vector2d& b);
  /// The part of a circle from a to b, counter-clockwise; both are as far away from `middle`.
  void arc(const std::string& layer, const Eigen::Vector2d& middle, const Eigen::Vector2d& a, const Eigen::Vector2d& b);
  void closed_polyline(const std::string& layer, const PlanRing& ring);
  /// Centred at `middle`, turned counter-clockwise by `angle` (radians). UTF-8.
  void text(const std::string& layer, const Eigen::Vector2d& middle, double height, const std::string& text,
            double angle = 0);
  /// The whole file.
  std::string finish() &&;

 private:
  void begin(const char* kind, const std::string& layer, const char* type);
  /// The place in the file; it becomes part of the drawing's extents.
  Eigen::Vector2d placed(const Eigen::Vector2d& p);

  Eigen::Vector2d origin_;
  DxfFrame frame_;
  DxfGroups entities_;
};

}  // namespace atrium::floorplan
