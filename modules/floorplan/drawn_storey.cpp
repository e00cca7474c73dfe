#include "modules/floorplan/drawn_storey.hpp"

#include <algorithm>

#include "modules/floorplan/door_leaf.hpp"
#include "modules/floorplan/drawn_openings.hpp"
#include "modules/floorplan/room_label.hpp"
#include "modules/floorplan/wall_pieces.hpp"

namespace atrium::floorplan {
namespace {

constexpr double font = 1.4;  // font size per height of digits

// Whether another wall that is not parallel ends, or runs, where the wall has its end p.
bool at_corner(const PlanStorey& storey, const PlanWall& wall, const Eigen::Vector2d& p) {
  constexpr double near = 0.01;  // metres
  const Eigen::Vector2d along = (wall.to - wall.from).normalized();
  return std::any_of(storey.walls.begin(), storey.walls.end(), [&](const PlanWall& other) {
    const Eigen::Vector2d d = other.to - other.from;
    const double reach = std::clamp(d.dot(p - other.from) / d.squaredNorm(), 0.0, 1.0);
    return std::abs(cross(along, d.normalized())) > 0.17 &&
           (other.from + reach * d - p).norm() < 0.5 * other.thickness + near;
  });
}

// What is certainly wall behind the single faces: a band on the side from which they are not seen.
Region behind_faces(const PlanStorey& storey, double width) {
  std::vector<PlanRing> bands, open;
  for (const auto& wall : storey.walls) {
    if (wall.thickness > 0 || wall.inferred) continue;
    const Eigen::Vector2d along = (wall.to - wall.from).normalized();
    const Eigen::Vector2d aside = 0.5 * width * Eigen::Vector2d(along.y(), -along.x());
    const Eigen::Vector2d from = wall.from - (at_corner(storey, wall, wall.from) ? width : 0) * along;
    const Eigen::Vector2d to = wall.to + (at_corner(storey, wall, wall.to) ? width : 0) * along;
    bands.push_back(strip(from + aside, to + aside, 0.5 * width, 0));
  }
  Region rooms = storey.floors;
  for (const auto& room : storey.rooms) rooms.push_back(room.polygon);
  for (const auto& polygon : rooms) open.push_back(polygon.outline);
  return minus(minus(united(bands), united(open)), storey.bodies);
}

void draw_areas(SvgCanvas& canvas, const Pen& pen, const PlanStorey& storey) {
  canvas.begin_group("stroke=\"#b8b2a6\" stroke-width=\"0.13\"");
  for (const auto& floor : storey.floors) pen.polygon(floor, "fill=\"#f1eee7\"");
  canvas.end_group();
  // A room's edge shows where no wall stands on it.
  canvas.begin_group("fill=\"#fbfaf7\" stroke=\"#8a8a8a\" stroke-width=\"0.18\" stroke-dasharray=\"1.6 0.9\"");
  for (const auto& room : storey.rooms) pen.polygon(room.polygon, fmt::format("data-room=\"{}\"", escaped(room.name)));
  canvas.end_group();
}

void draw_walls(SvgCanvas& canvas, const Pen& pen, const PlanStorey& storey) {
  for (const auto& part : behind_faces(storey, hatch_width * pen.mm())) pen.polygon(part, "fill=\"url(#hatch)\"");
  canvas.begin_group("fill=\"#33363b\" stroke=\"#000\" stroke-width=\"0.35\" stroke-linejoin=\"miter\"");
  for (const auto& body : storey.bodies) pen.polygon(body);
  canvas.end_group();
  canvas.begin_group("fill=\"none\" stroke=\"#000\" stroke-width=\"0.5\" stroke-linecap=\"square\"");
  for (const auto& wall : storey.walls)
    if (wall.thickness <= 0 && !wall.inferred) pen.line(wall.from, wall.to);
  canvas.end_group();
  if (std::none_of(storey.walls.begin(), storey.walls.end(), [](const PlanWall& wall) { return wall.inferred; }))
    return;
  canvas.begin_group(
      "class=\"inferred\" fill=\"#fff\" stroke=\"#000\" stroke-width=\"0.35\" stroke-dasharray=\"1.8 1.2\"");
  for (const auto& wall : storey.walls) {
    if (!wall.inferred) continue;
    if (wall.thickness > 0)
      pen.polygon({wall.outline, {}});
    else
      pen.line(wall.from, wall.to);
  }
  canvas.end_group();
}

void draw_room_labels(SvgCanvas& canvas, const Pen& pen, const PlanStorey& storey) {
  std::vector<PlanWall> obstacles = storey.walls;
  const auto avoid = [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    obstacles.emplace_back().from = from;
    obstacles.back().to = to;
  };
  for (const auto& opening : storey.openings) {
    if (opening.kind == "slab")
      for (std::size_t i = 0; i < opening.outline.size(); ++i)
        avoid(opening.outline[i], opening.outline[(i + 1) % opening.outline.size()]);
    for (const auto& leaf : door_leaves(opening, storey)) avoid(leaf.hinge, leaf.open);
  }
  canvas.begin_group("fill=\"#1a1a1a\" text-anchor=\"middle\"");
  for (const auto& room : storey.rooms) {
    const std::string area = area_text(room.polygon.area(), pen.units());
    const std::string height = room.height > 0 ? "h " + length_text(room.height, pen.units()) : "h unknown";
    const bool doubtful = is_doubtful(room);
    const std::string doubt = doubtful ? confidence_text(room) : std::string();
    const double width = std::max({text_width(room.name, 2.6), text_width(area, 2.2), text_width(doubt, 1.8)}) + 2;
    const LabelPlace place =
        label_place(room.polygon, Eigen::Vector2d(width, doubtful ? 19 : 15) * pen.mm(), obstacles);
    const double size = std::max(place.scale, 0.45);  // below, no one could read it
    const Eigen::Vector2d at = pen.at(place.scale > 0 ? place.middle : room.polygon.outline.front());
    canvas.text(at + Eigen::Vector2d(0, -2.2 * size), 3.6 * size, room.name, "font-weight=\"bold\"");
    if (room.corrected) draw_correction_mark(canvas, at - Eigen::Vector2d(0, 7.2 * size));
    canvas.text(at + Eigen::Vector2d(0, 2.0 * size), 3.0 * size, area);
    canvas.text(at + Eigen::Vector2d(0, 5.8 * size), 2.5 * size, height, "fill=\"#666\"");
    if (doubtful) canvas.text(at + Eigen::Vector2d(0, 9.4 * size), 2.5 * size, doubt, "fill=\"#b00020\"");
  }
  canvas.end_group();
}

/// Marks at the middles of corrected walls and openings. Those of rooms stand over their names.
void draw_corrections(SvgCanvas& canvas, const Pen& pen, const PlanStorey& storey) {
  if (!has_corrections(storey)) return;
  canvas.begin_group("class=\"corrected\"");
  for (const auto& wall : storey.walls)
    if (wall.corrected) draw_correction_mark(canvas, pen.at(0.5 * (wall.from + wall.to)));
  for (const auto& opening : storey.openings)
    if (opening.corrected) draw_correction_mark(canvas, pen.at(mark_place(opening)));
  canvas.end_group();
}

bool draw_dimensions(SvgCanvas& canvas, const Pen& pen, const PlanStorey& storey) {
  bool inferred = false;
  const double mm = pen.mm();
  for (const auto& chain : dimensions_of(storey, mm, pen.units())) {
    canvas.begin_group("fill=\"none\" stroke=\"#444\" stroke-width=\"0.18\"");
    const double over = chain.outwards() * mm;
    pen.line(chain.at(chain.stops.front() - mm, chain.line), chain.at(chain.stops.back() + mm, chain.line));
    for (const double stop : chain.stops)
      pen.line(chain.at(stop, chain.from_building), chain.at(stop, chain.line + over));
    canvas.end_group();
    canvas.begin_group("fill=\"none\" stroke=\"#000\" stroke-width=\"0.4\"");
    for (const double stop : chain.stops) {
      const Eigen::Vector2d middle = chain.at(stop, chain.line), tick(0.7 * mm, 0.7 * mm);
      pen.line(middle - tick, middle + tick);
    }
    canvas.end_group();
    canvas.begin_group("fill=\"#1a1a1a\" text-anchor=\"middle\"");
    for (const auto& label : chain.labels) {
      const Eigen::Vector2d down =
          label.upwards ? Eigen::Vector2d(0.5 * label.height, 0) : Eigen::Vector2d(0, -0.5 * label.height);
      canvas.text(pen.at(label.middle + down), label.height / mm * font, label.text, {}, label.upwards ? -90 : 0);
      inferred = inferred || label.inferred;
    }
    canvas.end_group();
  }
  return inferred;
}

void draw_caption(SvgCanvas& canvas, const Pen& pen, const PlanStorey& storey, const Caption& caption) {
  const Bounds2 box = drawing_bounds(storey, pen.mm(), pen.units()), building = bounds(storey);
  const double left = building.empty() ? box.low.x() : building.low.x();
  const Eigen::Vector2d at = pen.at({left, box.high.y()}) - Eigen::Vector2d(0, caption.height() - 4);
  const auto row = [&](double right, double down, const std::string& text) {
    canvas.text(at + Eigen::Vector2d(right, down), Caption::size, text, "fill=\"#444\"");
  };
  canvas.text(at, Caption::name_size, caption.name, "font-weight=\"bold\"");
  if (caption.stacked) {
    row(0, Caption::line, caption.level);
    row(0, 2 * Caption::line, caption.content);
  } else {
    row(caption.name_width() + 3, 0, caption.about());
  }
}

}  // namespace

Eigen::Vector2d mark_place(const PlanOpening& opening) {
  if (opening.kind != "slab") return 0.5 * (opening.from + opening.to);
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const auto& p : opening.outline) middle += p / static_cast<double>(opening.outline.size());
  return middle;
}

bool has_corrections(const PlanStorey& storey) {
  const auto any = [](const auto& all) {
    return std::any_of(all.begin(), all.end(), [](const auto& item) { return item.corrected; });
  };
  return any(storey.walls) || any(storey.openings) || any(storey.rooms);
}

void draw_correction_mark(SvgCanvas& canvas, const Eigen::Vector2d& middle) {
  constexpr double half = 1.1;  // millimetres
  canvas.polygon({{middle + Eigen::Vector2d(0, -half), middle + Eigen::Vector2d(half, 0),
                   middle + Eigen::Vector2d(0, half), middle + Eigen::Vector2d(-half, 0)}},
                 "fill=\"#d6006c\" stroke=\"#fff\" stroke-width=\"0.25\"");
}

bool draw_storey(SvgCanvas& canvas, const Sheet& sheet, std::size_t index, const PlanStorey& storey, bool dimensions) {
  const Pen pen(canvas, sheet, index);
  canvas.begin_group(fmt::format("id=\"storey-{}\"", storey.index));
  draw_areas(canvas, pen, storey);
  draw_walls(canvas, pen, storey);
  draw_openings(canvas, pen, storey);
  draw_corrections(canvas, pen, storey);
  draw_room_labels(canvas, pen, storey);
  const bool inferred = dimensions && draw_dimensions(canvas, pen, storey);
  draw_caption(canvas, pen, storey, sheet.captions[index]);
  canvas.end_group();
  return inferred;
}

}  // namespace atrium::floorplan
