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

#include <cmath>

namespace atrium::render {
namespace {

struct Pen {
  vtkRenderer* renderer;
  double grey;

  void text(const std::string& words, double x, double y, int size, bool centred = false, bool from_top = false) const {
    vtkNew<vtkTextActor> actor;
    actor->SetInput(words.c_str());
    actor->SetPosition(x, y);
    auto* property = actor->GetTextProperty();
    property->SetFontFamilyToArial();
    property->SetFontSize(size);
    property->SetColor(grey, grey, grey);
    if (centred) property->SetJustificationToCentered();
    if (from_top) property->SetVerticalJustificationToTop();
    renderer->AddActor2D(actor);
  }
  void box(double x, double y, double width, double height, double r, double g, double b) const {
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

void add_overlay(vtkRenderer* renderer, const Overlay& overlay, int width, int height) {
  const Pen pen{renderer, overlay.dark_background ? 0.95 : 0.1};
  const double unit = height / 45.0;
  const int font = static_cast<int>(unit);
  if (!overlay.title.empty()) pen.text(overlay.title, unit, height - unit, static_cast<int>(1.3 * unit), false, true);
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
    pen.text(fmt::format("{:g} m", length), width - unit - pixels / 2, 1.6 * unit, font, true);
  }
}

}  // namespace atrium::render
