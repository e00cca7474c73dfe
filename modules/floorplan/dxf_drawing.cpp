#include "modules/floorplan/dxf_drawing.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace atrium::floorplan {
namespace {

constexpr int is_closed = 1, centred = 1, at_half_height = 2;
constexpr double degree = std::numbers::pi / 180;

}  // namespace

DxfDrawing::DxfDrawing(Eigen::Vector2d origin, std::vector<DxfLayer> layers, const Bounds2& view)
    : origin_(std::move(origin)) {
  frame_.next_handle = first_entity_handle(layers.size());
  frame_.layers = std::move(layers);
  if (view.empty()) return;
  frame_.view.add(origin_ + view.low);
  frame_.view.add(origin_ + view.high);
}

void DxfDrawing::begin(const char* kind, const std::string& layer, const char* type) {
  entities_.record(kind, frame_.next_handle++, dxf_model_space);
  entities_.subclass("AcDbEntity");
  entities_.text(8, layer);
  entities_.subclass(type);
}

Eigen::Vector2d DxfDrawing::placed(const Eigen::Vector2d& p) {
  Eigen::Vector2d place = origin_ + p;
  frame_.extents.add(place);
  return place;
}

void DxfDrawing::line(const std::string& layer, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  begin("LINE", layer, "AcDbLine");
  entities_.point(10, placed(a), 0);
  entities_.point(11, placed(b), 0);
}

void DxfDrawing::arc(const std::string& layer, const Eigen::Vector2d& middle, const Eigen::Vector2d& a,
                     const Eigen::Vector2d& b) {
  const auto degrees = [&](const Eigen::Vector2d& p) {
    const double angle = std::atan2(p.y() - middle.y(), p.x() - middle.x()) / degree;
    return angle < 0 ? angle + 360 : angle;
  };
  const double radius = (a - middle).norm(), from = degrees(a), to = degrees(b);
  begin("ARC", layer, "AcDbCircle");
  entities_.point(10, origin_ + middle, 0);
  entities_.real(40, radius);
  entities_.subclass("AcDbArc");
  entities_.real(50, from);
  entities_.real(51, to);
  placed(a);
  placed(b);
  // Where it crosses the axes through its middle, it may reach farther than its ends.
  const double last = to < from ? to + 360 : to;
  for (double angle = 90 * std::ceil(from / 90); angle < last; angle += 90)
    placed(middle + radius * Eigen::Vector2d(std::cos(angle * degree), std::sin(angle * degree)));
}

void DxfDrawing::closed_polyline(const std::string& layer, const PlanRing& ring) {
  begin("LWPOLYLINE", layer, "AcDbPolyline");
  entities_.integer(90, static_cast<std::int64_t>(ring.size()));
  entities_.integer(70, is_closed);
  entities_.real(43, 0);
  for (const auto& corner : ring) entities_.point(10, placed(corner));
}

void DxfDrawing::text(const std::string& layer, const Eigen::Vector2d& middle, double height, const std::string& text,
                      double angle) {
  const Eigen::Vector2d at = origin_ + middle;
  begin("TEXT", layer, "AcDbText");
  entities_.point(10, at, 0);
  entities_.real(40, height);
  entities_.text(1, dxf_text(text));
  entities_.real(50, angle / degree);
  entities_.integer(72, centred);
  entities_.point(11, at, 0);
  entities_.subclass("AcDbText");
  entities_.integer(73, at_half_height);
  // A character is about as wide as it is high.
  const auto characters = std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; });
  const Eigen::Vector2d half(0.5 * height * static_cast<double>(characters), 0.5 * height);
  for (const double side : {-1.0, 1.0})
    for (const double end : {-1.0, 1.0})
      placed(middle + Eigen::Rotation2Dd(angle) * Eigen::Vector2d(end * half.x(), side * half.y()));
}

std::string DxfDrawing::finish() && {
  DxfGroups all = dxf_beginning(frame_);
  all.begin_section("ENTITIES");
  all.append(entities_);
  all.end_section();
  all.append(dxf_end(frame_));
  return all.all();
}

}  // namespace atrium::floorplan
