#include <cmath>

#include "graph/api/text.hpp"
#include "modules/floorplan/drawn_storey.hpp"
#include "modules/floorplan/fitted_text.hpp"

namespace atrium::floorplan {
namespace {

void draw_north(SvgCanvas& canvas, const Eigen::Vector2d& centre, double north) {
  constexpr double radius = 6.5;
  const Eigen::Vector2d up(-std::sin(north), -std::cos(north)), right(-up.y(), up.x());
  const Eigen::Vector2d tip = centre + radius * up, tail = centre - 0.55 * radius * up;
  canvas.raw(
      fmt::format("<circle cx=\"{:.3f}\" cy=\"{:.3f}\" r=\"{:g}\" fill=\"none\" stroke=\"#000\" "
                  "stroke-width=\"0.18\"/>\n",
                  centre.x(), centre.y(), radius));
  const Eigen::Vector2d foot = centre - 0.8 * radius * up;
  canvas.begin_group("stroke=\"#000\" stroke-width=\"0.25\" stroke-linejoin=\"miter\"");
  canvas.polygon({{tip, foot + 0.42 * radius * right, tail}}, "fill=\"#000\"");
  canvas.polygon({{tip, foot - 0.42 * radius * right, tail}}, "fill=\"#fff\"");
  canvas.end_group();
  const Eigen::Vector2d letter = centre + (radius + 2.2) * up;
  canvas.text(letter + Eigen::Vector2d(0, 1.1), 3.2, "y", "text-anchor=\"middle\" font-weight=\"bold\"");
}

// A bar of five steps of 1, 2 or 5 times a power of ten metres (or feet), as long as there is room for.
void draw_scale(SvgCanvas& canvas, const Sheet& sheet, const Eigen::Vector2d& corner) {
  const bool feet = sheet.units == Units::feet;
  const double per_unit = sheet.per_metre() * (feet ? 0.3048 : 1);
  double step = 0.1;
  for (const double factor : {0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0})
    if (5 * factor * per_unit <= 52) step = factor;
  const double length = step * per_unit, height = 1.6;
  canvas.begin_group("stroke=\"#000\" stroke-width=\"0.2\"");
  for (int i = 0; i < 5; ++i)
    canvas.rectangle(corner + Eigen::Vector2d(i * length, 0), {length, height},
                     i % 2 == 0 ? "fill=\"#000\"" : "fill=\"#fff\"");
  canvas.end_group();
  canvas.begin_group("text-anchor=\"middle\" fill=\"#1a1a1a\"");
  for (int i = 0; i <= 5; ++i)
    canvas.text(corner + Eigen::Vector2d(i * length, -1.2), 2.4,
                fmt::format("{:g}{}", i * step,
                            i < 5  ? ""
                            : feet ? " ft"
                                   : " m"));
  canvas.end_group();
}

}  // namespace

void draw_title(SvgCanvas& canvas, const Sheet& sheet, const TitleBlock& block) {
  const Eigen::Vector2d frame = sheet.size - Eigen::Vector2d::Constant(2 * frame_margin);
  const double top = sheet.size.y() - frame_margin - title_height, left = frame_margin;
  const double right = sheet.size.x() - frame_margin;
  canvas.begin_group("fill=\"none\" stroke=\"#000\" stroke-width=\"0.5\"");
  canvas.rectangle({left, frame_margin}, frame);
  canvas.line({left, top}, {right, top});
  canvas.end_group();
  canvas.begin_group("fill=\"none\" stroke=\"#000\" stroke-width=\"0.25\"");
  canvas.line({right - 24, top}, {right - 24, top + title_height});
  canvas.line({right - 90, top}, {right - 90, top + title_height});
  canvas.end_group();
  canvas.begin_group("fill=\"#1a1a1a\"");
  const auto fit = [&](const Eigen::Vector2d& at, const FittedText& fitted, std::string_view attributes) {
    canvas.text(at, fitted.size, fitted.text, attributes);
  };
  const double width = right - 90 - (left + 5) - 3;
  fit({left + 5, top + 8.5}, fitted(block.title, width, 5, 3, true), "font-weight=\"bold\"");
  const std::string holds = fmt::format("{} \u00B7 {} \u00B7 {}", counted(block.storeys, "storey"),
                                        counted(block.rooms, "room"), area_text(block.area, sheet.units)) +
                            (block.accuracy.empty() ? std::string() : " \u00B7 " + block.accuracy);
  fit({left + 5, top + 14.5}, fitted(holds, width, 2.8, 1.7), {});
  double legend = 0;  // what it takes of the line
  if (block.corrected) {
    const std::string text = "corrected by hand";
    draw_correction_mark(canvas, {left + 6.1, top + 18.7});
    canvas.text({left + 8.5, top + 19.5}, 2.4, text, "fill=\"#555\"");
    legend = 8.5 + font_width(text, 2.4, false);
  }
  if (block.inferred) {
    const std::string text = "(1.00) ends at a wall that was not seen";
    canvas.text({left + 5 + legend, top + 19.5}, 2.4, text, "fill=\"#555\"");
    legend += font_width(text, 2.4, false) + 4;
  }
  fit({left + 5 + legend, top + 19.5}, fitted(block.note, width - legend, 2.4, 1.5), "fill=\"#555\"");
  const std::string scale = fmt::format("1:{}", sheet.scale),
                    paper = fmt::format("on {}, dimensions in {}", sheet.paper, name_of(sheet.units));
  canvas.text({right - 85, top + 7.5}, 4, scale, "font-weight=\"bold\"");
  fit({right - 29, top + 7.5}, fitted(paper, 56 - font_width(scale, 4, true) - 2, 2.6, 1.6), "text-anchor=\"end\"");
  draw_scale(canvas, sheet, {right - 85, top + 16});
  draw_north(canvas, {right - 12, top + 0.5 * title_height + (std::cos(block.north) > 0 ? 1.5 : -1.5)}, block.north);
  canvas.end_group();
}

}  // namespace atrium::floorplan
