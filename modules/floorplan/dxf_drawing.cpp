#include "modules/floorplan/dxf_drawing.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace atrium::floorplan {
namespace {

constexpr int is_closed = 1, centred = 1, at_half_height = 2;
constexpr int rotated = 0, own_block = 32, text_placed = 128, middle_centre = 5;  // of a DIMENSION
constexpr double degree = std::numbers::pi / 180;

}  // namespace

DxfDrawing::DxfDrawing(const Eigen::Vector2d& origin, std::vector<DxfLayer> layers, const Bounds2& view, DxfScale scale)
    : unit_(cad_units_per_metre(scale.units)), origin_(unit_ * origin) {
  frame_.next_handle = first_entity_handle(layers.size());
  frame_.layers = std::move(layers);
  frame_.units = scale.units;
  frame_.mm = unit_ * scale.plotted / 1000.0;
  if (view.empty()) return;
  frame_.view.add(origin_ + unit_ * view.low);
  frame_.view.add(origin_ + unit_ * view.high);
}

void DxfDrawing::begin(const char* kind, const std::string& layer, const char* type) {
  out().record(kind, frame_.next_handle++, block_ ? block_->record : dxf_model_space);
  out().subclass("AcDbEntity");
  out().text(8, layer);
  out().subclass(type);
}

Eigen::Vector2d DxfDrawing::placed(const Eigen::Vector2d& p) {
  Eigen::Vector2d place = origin_ + unit_ * p;
  frame_.extents.add(place);
  return place;
}

Bounds2 DxfDrawing::extents() const {
  Bounds2 result;
  if (frame_.extents.empty()) return result;
  result.add((frame_.extents.low - origin_) / unit_);
  result.add((frame_.extents.high - origin_) / unit_);
  return result;
}

void DxfDrawing::line(const std::string& layer, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  begin("LINE", layer, "AcDbLine");
  out().point(10, placed(a), 0);
  out().point(11, placed(b), 0);
}

void DxfDrawing::arc(const std::string& layer, const Eigen::Vector2d& middle, const Eigen::Vector2d& a,
                     const Eigen::Vector2d& b) {
  const auto degrees = [&](const Eigen::Vector2d& p) {
    const double angle = std::atan2(p.y() - middle.y(), p.x() - middle.x()) / degree;
    return angle < 0 ? angle + 360 : angle;
  };
  const double radius = (a - middle).norm(), from = degrees(a), to = degrees(b);
  begin("ARC", layer, "AcDbCircle");
  out().point(10, origin_ + unit_ * middle, 0);
  out().real(40, unit_ * radius);
  out().subclass("AcDbArc");
  out().real(50, from);
  out().real(51, to);
  placed(a);
  placed(b);
  // Where it crosses the axes through its middle, it may reach farther than its ends.
  const double last = to < from ? to + 360 : to;
  for (double angle = 90 * std::ceil(from / 90); angle < last; angle += 90)
    placed(middle + radius * Eigen::Vector2d(std::cos(angle * degree), std::sin(angle * degree)));
}

void DxfDrawing::closed_polyline(const std::string& layer, const PlanRing& ring) {
  begin("LWPOLYLINE", layer, "AcDbPolyline");
  out().integer(90, static_cast<std::int64_t>(ring.size()));
  out().integer(70, is_closed);
  out().real(43, 0);
  for (const auto& corner : ring) out().point(10, placed(corner));
}

void DxfDrawing::text(const std::string& layer, const Eigen::Vector2d& middle, double height, const std::string& text,
                      double angle) {
  const Eigen::Vector2d at = origin_ + unit_ * middle;
  begin("TEXT", layer, "AcDbText");
  out().point(10, at, 0);
  out().real(40, unit_ * height);
  out().text(1, dxf_text(text));
  out().real(50, angle / degree);
  out().integer(72, centred);
  out().point(11, at, 0);
  out().subclass("AcDbText");
  out().integer(73, at_half_height);
  // A character is about as wide as it is high.
  const auto characters = std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; });
  const Eigen::Vector2d half(0.5 * height * static_cast<double>(characters), 0.5 * height);
  for (const double side : {-1.0, 1.0})
    for (const double end : {-1.0, 1.0})
      placed(middle + Eigen::Rotation2Dd(angle) * Eigen::Vector2d(end * half.x(), side * half.y()));
}

void DxfDrawing::dimension(const std::string& layer, const Dimension& dimension) {
  const auto& [from, to, line_from, line_to, middle, shown, angle, height, moved, inferred] = dimension;
  const double mm = frame_.mm / unit_;
  block_.emplace();
  block_->name = fmt::format("*D{}", frame_.blocks.size() + 1);
  for (DxfHandle* handle : {&block_->record, &block_->begin, &block_->end}) *handle = frame_.next_handle++;
  // What lies on layer 0 of a block is on the layer of what shows the block.
  const Eigen::Vector2d tick = dxf_tick * mm * (Eigen::Rotation2Dd(angle + 45 * degree) * Eigen::Vector2d::UnitX());
  line("0", line_from, line_to);
  for (const auto& [foot, head] : {std::pair(from, line_from), std::pair(to, line_to)}) {
    const Eigen::Vector2d away = (head - foot).normalized();
    line("0", foot + dxf_extension_gap * mm * away, head + dxf_extension_over * mm * away);
    line("0", head - std::sqrt(2.0) * tick, head + std::sqrt(2.0) * tick);
  }
  text("0", middle, height, shown, angle);
  frame_.blocks.push_back(std::move(*block_));
  block_.reset();
  begin("DIMENSION", layer, "AcDbDimension");
  out().text(2, frame_.blocks.back().name);
  out().point(10, placed(line_to), 0);
  out().point(11, placed(middle), 0);
  out().integer(70, rotated | own_block | (moved ? text_placed : 0));
  if (inferred) out().text(1, "(<>)");
  out().integer(71, middle_centre);
  out().real(42, unit_ * (line_to - line_from).norm());
  out().text(3, dxf_dimension_style);
  out().subclass("AcDbAlignedDimension");
  out().point(13, placed(from), 0);
  out().point(14, placed(to), 0);
  out().real(50, angle / degree);
  out().subclass("AcDbRotatedDimension");
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
