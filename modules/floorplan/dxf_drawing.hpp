#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/floorplan/plan_view.hpp"

namespace atrium::floorplan {

struct DxfLayer {
  std::string name;
  int colour = 7;        ///< AutoCAD colour index
  int line_weight = 25;  ///< hundredths of a millimetre
};

/// Text as DXF 2000 has it: ASCII, with \U+XXXX for other characters; control characters are left out.
std::string dxf_text(std::string_view utf8);

/// A DXF file of release 2000 that is being written by dxflib. Places are relative to `origin`; it opens with `view` in
/// sight.
class DxfDrawing {
 public:
  DxfDrawing(AtomicFile& file, const Eigen::Vector2d& origin, const std::vector<DxfLayer>& layers, const Bounds2& view);
  ~DxfDrawing();
  DxfDrawing(const DxfDrawing&) = delete;
  DxfDrawing& operator=(const DxfDrawing&) = delete;

  void line(const std::string& layer, const Eigen::Vector2d& a, const Eigen::Vector2d& b);
  /// The part of a circle from a to b, counter-clockwise.
  void arc(const std::string& layer, const Eigen::Vector2d& middle, const Eigen::Vector2d& a, const Eigen::Vector2d& b);
  void closed_polyline(const std::string& layer, const PlanRing& ring);
  /// Centred at `middle`, turned counter-clockwise by `angle` (radians).
  void text(const std::string& layer, const Eigen::Vector2d& middle, double height, const std::string& text,
            double angle = 0);
  /// Ends the file and checks that all of it was written; throws Error.
  void finish();

 private:
  struct Writer;
  std::unique_ptr<Writer> writer_;
};

}  // namespace atrium::floorplan
