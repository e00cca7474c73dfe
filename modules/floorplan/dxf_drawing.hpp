#pragma once
#include <optional>
#include <string>
#include <vector>

#include "modules/floorplan/dxf_frame.hpp"

namespace atrium::floorplan {

/// How the coordinates of a drawing follow from places.
struct DxfScale {
  Units units = Units::metres;
  int plotted = 100;  ///< sizes of dimensions are those of a plot at 1 : plotted
};

/// Collects the entities of a drawing and makes a DXF file of release 2000 (AC1015, text) of them, in the model space,
/// z = 0. Places and lengths are in metres, places relative to `origin`; the file has them in the unit of `scale`. It
/// opens with `view` in sight. All methods throw Error for a coordinate that is not finite.
class DxfDrawing {
 public:
  DxfDrawing(const Eigen::Vector2d& origin, std::vector<DxfLayer> layers, const Bounds2& view, DxfScale scale = {});

  void line(const std::string& layer, const Eigen::Vector2d& a, const Eigen::Vector2d& b);
  /// The part of a circle from a to b, counter-clockwise; both are as far away from `middle`.
  void arc(const std::string& layer, const Eigen::Vector2d& middle, const Eigen::Vector2d& a, const Eigen::Vector2d& b);
  void closed_polyline(const std::string& layer, const PlanRing& ring);
  /// Centred at `middle`, turned counter-clockwise by `angle` (radians). UTF-8.
  void text(const std::string& layer, const Eigen::Vector2d& middle, double height, const std::string& text,
            double angle = 0);
  /// The distance of two places along a line that is turned by `angle`: a DIMENSION, with its look in a block.
  struct Dimension {
    Eigen::Vector2d from, to;            ///< what is measured, where the extension lines begin (with a gap)
    Eigen::Vector2d line_from, line_to;  ///< the same on the dimension line
    Eigen::Vector2d middle;              ///< of the text
    std::string text;
    double angle = 0;       ///< radians: of line_from → line_to, and of the text
    double height = 0;      ///< of the text
    bool moved = false;     ///< the text stands where a program would not put it by itself
    bool inferred = false;  ///< programs that measure it anew put it in parentheses, too
  };
  void dimension(const std::string& layer, const Dimension& dimension);
  /// A line of text at the file's beginning, for those who read the file.
  void comment(std::string text) { frame_.comment = std::move(text); }
  /// Of all so far, as places.
  Bounds2 extents() const;
  /// The whole file.
  std::string finish() &&;

 private:
  DxfGroups& out() { return block_ ? block_->entities : entities_; }
  void begin(const char* kind, const std::string& layer, const char* type);
  /// The place in the file; it becomes part of the drawing's extents.
  Eigen::Vector2d placed(const Eigen::Vector2d& p);

  double unit_;             ///< of the file, per metre
  Eigen::Vector2d origin_;  ///< in the file's unit
  DxfFrame frame_;
  DxfGroups entities_;
  std::optional<DxfBlock> block_;  ///< what entities go into, if any
};

}  // namespace atrium::floorplan
