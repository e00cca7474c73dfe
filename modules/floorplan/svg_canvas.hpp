#pragma once
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "modules/types/floor_plan.hpp"

namespace atrium::floorplan {

/// Text of an SVG file or an attribute's value, with its special characters escaped; characters that XML does not allow
/// (control characters, broken UTF-8) become U+FFFD.
std::string escaped(std::string_view text);

/// Length of the UTF-8 character that begins at text[i], 0 if it is none or not allowed in XML.
std::size_t character_length(std::string_view text, std::size_t i);

/// Collects the elements of an SVG drawing whose unit is the millimetre of paper.
class SvgCanvas {
 public:
  SvgCanvas(double width, double height, std::string_view title);

  /// Attributes for all that follows until end_group: `fill="none" stroke="#000"`.
  void begin_group(std::string_view attributes);
  void end_group() { text_ += "</g>\n"; }
  void line(const Eigen::Vector2d& a, const Eigen::Vector2d& b);
  /// The shorter part of a circle from a to b, both `radius` away from its middle; clockwise as it is seen.
  void arc(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double radius, bool clockwise);
  /// Closed; holes are rings that run the other way round.
  void polygon(const std::vector<PlanRing>& rings, std::string_view attributes = {});
  void rectangle(const Eigen::Vector2d& corner, const Eigen::Vector2d& size, std::string_view attributes = {});
  void raw(std::string_view element) { text_ += element; }
  /// `size` is the font's, about 1.4 times the height of its digits; turned by `degrees` clockwise about `at`.
  void text(const Eigen::Vector2d& at, double size, std::string_view text, std::string_view attributes = {},
            double degrees = 0);
  std::string finish() && { return std::move(text_) + "</svg>\n"; }

 private:
  std::string text_;
};

}  // namespace atrium::floorplan
