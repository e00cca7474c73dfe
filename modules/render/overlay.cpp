#include "modules/render/overlay.hpp"

#include <fmt/format.h>
#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>

namespace atrium::render {
namespace {

struct Pen {
  enum class Align { left, centre, right };
  vtkRenderer* behind;
  vtkRenderer* renderer;
  double grey;

  void text(const std::string& words, double x, double y, int size, Align align = Align::left,
            bool from_top = false) const {
    vtkNew<vtkTextActor> actor;
    actor->SetInput(words.c_str());
    actor->SetPosition(x, y);
    auto* property = actor->GetTextProperty();
    property->SetFontFamilyToArial();
    property->SetFontSize(size);
    property->SetColor(grey, grey, grey);
    if (align == Align::centre) property->SetJustificationToCentered();
    if (align == Align::right) property->SetJustificationToRight();
    if (from_top) property->SetVerticalJustificationToTop();
    renderer->AddActor2D(actor);
  }
  /// Makes words readable on what is behind them.
  void plate(double x, double y, double width, double height) const {
    const double paper = grey > 0.5 ? 0 : 1;
    Pen{behind, behind, grey}.box(x, y, width, height, paper, paper, paper, 0.8);
  }
  void box(double x, double y, double width, double height, double r, double g, double b, double opacity = 1) const {
    vtkNew<vtkPoints> points;
    points->InsertNextPoint(x, y, 0);
    points->InsertNextPoint(x + width, y, 0);
    points->InsertNextPoint(x + width, y + height, 0);
    points->InsertNextPoint(x, y + height, 0);
    vtkNew<vtkCellArray> cells;
    cells->InsertNextCell({0, 1, 2, 3});
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetPolys(cells);
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputData(data);
    vtkNew<vtkActor2D> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(r, g, b);
    actor->GetProperty()->SetOpacity(opacity);
    renderer->AddActor2D(actor);
  }
};

}  // namespace

double round_bar_length(double metres_across) {
  const double most = metres_across / 4;
  const double decade = std::pow(10.0, std::floor(std::log10(most)));
  for (const double step : {5.0, 2.0})
    if (step * decade <= most) return step * decade;
  return decade;
}

BarMarks bar_marks(double low, double high) {
  const double largest = std::max(std::abs(low), std::abs(high));
  BarMarks marks = largest <= 0.02 ? BarMarks{"mm", 1000, {}}
                   : largest <= 1  ? BarMarks{"cm", 100, {}}
                                   : BarMarks{"m", 1, {}};
  const double step = round_up((high - low) / 6);
  for (double k = std::ceil(low / step - 1e-6); k * step <= high + 1e-6 * step; ++k)
    marks.values.push_back(k * step + 0.0);
  return marks;
}

namespace {

/// A vertical bar at the right, with its marks and what it measures.
void add_colour_bar(const Pen& pen, const ColourScale& scale, double unit, int width, int height) {
  constexpr int steps = 128;
  const double bar = std::min(0.45 * height, 16 * unit);
  const double left = width - 5.2 * unit;
  const double bottom = 0.5 * (height - bar);
  pen.plate(width - colour_bar_width * unit, bottom - unit, colour_bar_width * unit, bar + 5 * unit);
  for (int i = 0; i < steps; ++i) {
    const Colour colour = scale.map.at((i + 0.5) / steps);
    pen.box(left, bottom + bar * i / steps, unit, bar / steps + 1, colour[0] / 255.0, colour[1] / 255.0,
            colour[2] / 255.0);
  }
  const BarMarks marks = bar_marks(scale.low, scale.high);
  for (const double value : marks.values) {
    const double y = bottom + bar * (value - scale.low) / (scale.high - scale.low);
    pen.box(left + unit, y - unit / 16, unit / 3, unit / 8, pen.grey, pen.grey, pen.grey);
    pen.text(fmt::format("{:g}", std::round(value * marks.factor * 1e6) / 1e6 + 0.0), left + 1.6 * unit,
             y - 0.36 * unit, static_cast<int>(unit));
  }
  pen.text(scale.quantity, width - unit, bottom + bar + 2.3 * unit, static_cast<int>(unit), Pen::Align::right);
  pen.text("in " + marks.unit, width - unit, bottom + bar + 0.9 * unit, static_cast<int>(unit), Pen::Align::right);
}

}  // namespace

std::vector<Eigen::AlignedBox2d> plates_of(const Overlay& overlay, int width, int height) {
  const double unit = height * overlay.text_size;
  std::vector<Eigen::AlignedBox2d> plates;
  const auto add = [&](double x, double y, double across, double up) {
    plates.emplace_back(Eigen::Vector2d(x, y), Eigen::Vector2d(x + across, y + up));
  };
  if (!overlay.title.empty()) {
    const double words = 0.8 * static_cast<double>(overlay.title.size());
    add(unit / 2, height - 2.8 * unit, std::min(words * unit + unit, width - unit), 2.3 * unit);
  }
  std::size_t longest = 0;
  for (const auto& [name, colour] : overlay.legend) longest = std::max(longest, name.size());
  if (longest > 0)
    add(unit / 2, unit / 2, (2.9 + 0.62 * static_cast<double>(longest)) * unit,
        (1.6 * static_cast<double>(overlay.legend.size()) + 0.4) * unit);
  return plates;
}

void add_overlay(vtkRenderer* picture, vtkRenderer* front, const Overlay& overlay, int width, int height) {
  const Pen pen{picture, front, overlay.dark_background ? 0.95 : 0.1};
  const double unit = height * overlay.text_size;
  const int font = static_cast<int>(unit);
  for (const auto& plate : plates_of(overlay, width, height))
    pen.plate(plate.min().x(), plate.min().y(), plate.sizes().x(), plate.sizes().y());
  if (!overlay.title.empty())
    pen.text(overlay.title, unit, height - unit, static_cast<int>(1.3 * unit), Pen::Align::left, true);
  double y = unit;
  for (auto it = overlay.legend.rbegin(); it != overlay.legend.rend(); ++it) {
    const auto& [name, colour] = *it;
    pen.box(unit, y, unit, unit, colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0);
    pen.text(name, 2.6 * unit, y, font);
    y += 1.6 * unit;
  }
  if (overlay.scale_bar > 0) {
    const double length = round_bar_length(overlay.scale_bar);
    const double pixels = length / overlay.scale_bar * width;
    pen.box(width - unit - pixels, unit, pixels, unit / 4, pen.grey, pen.grey, pen.grey);
    pen.text(fmt::format("{:g} m", length), width - unit - pixels / 2, 1.6 * unit, font, Pen::Align::centre);
  }
  if (overlay.colours) add_colour_bar(pen, *overlay.colours, unit, width, height);
}

}  // namespace atrium::render
