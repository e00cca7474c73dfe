#include "modules/floorplan/write_dxf.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <numbers>

#include "graph/api/write_output.hpp"
#include "modules/floorplan/dimensions.hpp"
#include "modules/floorplan/door_leaf.hpp"
#include "modules/floorplan/drawn_openings.hpp"
#include "modules/floorplan/drawn_storey.hpp"
#include "modules/floorplan/dxf_drawing.hpp"
#include "modules/floorplan/room_label.hpp"
#include "modules/types/crs_name.hpp"

namespace atrium::floorplan {
namespace {

const std::vector<DxfLayer> layers{{"A-WALL", 7, 50},      {"A-WALL-CNTR", 1, 13}, {"A-WALL-FACE", 7, 50},
                                   {"A-FLOR", 9, 13},      {"A-CLNG", 4, 13},      {"A-AREA", 3, 18},
                                   {"A-DOOR", 30, 25},     {"A-GLAZ", 5, 25},      {"A-FLOR-OVHD", 8, 18},
                                   {"A-AREA-IDEN", 2, 18}, {"A-ANNO-DIMS", 8, 18}, {"A-WALL-INFR", 6, 18}};
constexpr const char* note_layer = "A-ANNO-NOTE";
/// Revisions: the mark of what was corrected by hand. Only where something was.
const DxfLayer revision_layer{"A-ANNO-REVS", 1, 25};

class StoreyDrawing {
 public:
  StoreyDrawing(DxfDrawing& drawing, std::string suffix, double mm, Units units)
      : drawing_(drawing), suffix_(std::move(suffix)), mm_(mm), units_(units) {}

  void walls(const PlanStorey& storey) {
    polygons("A-WALL", storey.bodies);
    for (const auto& wall : storey.walls)
      if (wall.inferred && wall.outline.size() > 2)
        drawing_.closed_polyline("A-WALL-INFR" + suffix_, wall.outline);
      else
        drawing_.line((wall.inferred        ? "A-WALL-INFR"
                       : wall.thickness > 0 ? "A-WALL-CNTR"
                                            : "A-WALL-FACE") +
                          suffix_,
                      wall.from, wall.to);
  }

  void areas(const PlanStorey& storey) {
    polygons("A-FLOR", storey.floors);
    polygons("A-CLNG", storey.ceilings);
    for (const auto& room : storey.rooms) polygons("A-AREA", {room.polygon});
  }

  void openings(const PlanStorey& storey) {
    for (const auto& opening : storey.openings) {
      if (opening.kind == "slab")
        slab(opening, storey);
      else if (opening.kind == "window")
        window(opening);
      else
        door(opening, storey);
    }
  }

  // In the plan's own axes, turned by `turn` from those that the walls are parallel to.
  void labels(const PlanStorey& storey, double turn) {
    const Eigen::Rotation2Dd back(turn);
    for (const auto& room : storey.rooms) {
      const LabelPlace place = label_place(room.polygon, Eigen::Vector2d(20, 15) * mm_, storey.walls);
      const Eigen::Vector2d middle = place.scale > 0 ? place.middle : room.polygon.outline.front();
      std::vector<std::string> rows{room.name, area_text(room.polygon.area(), units_)};
      if (room.height > 0) rows.push_back("h " + length_text(room.height, units_, true));
      if (is_doubtful(room)) rows.push_back(confidence_text(room));
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const double down = (static_cast<double>(i) - 0.5 * static_cast<double>(rows.size() - 1)) * 4 * mm_;
        drawing_.text("A-AREA-IDEN" + suffix_, middle + back * Eigen::Vector2d(0, -down), 2.5 * mm_, rows[i], turn);
      }
    }
  }

  void dimensions(const PlanStorey& storey, double turn) {
    const std::string layer = "A-ANNO-DIMS" + suffix_;
    const Eigen::Rotation2Dd back(turn);
    for (const auto& chain : dimensions_of(turned(storey, turn), mm_, units_, true)) {
      const double foot = chain.from_building - chain.outwards() * dxf_extension_gap * mm_;
      for (const auto& label : chain.labels)
        drawing_.dimension(layer, {back * chain.at(label.from, foot), back * chain.at(label.to, foot),
                                   back * chain.at(label.from, chain.line), back * chain.at(label.to, chain.line),
                                   back * label.middle, label.text, turn + (label.upwards ? 0.5 * std::numbers::pi : 0),
                                   label.height, label.aside, label.inferred});
    }
  }

  /// Diamonds as on the sheets: at the middles of walls and openings, over the names of rooms.
  void corrections(const PlanStorey& storey, double turn) {
    for (const auto& wall : storey.walls)
      if (wall.corrected) mark(0.5 * (wall.from + wall.to), turn);
    for (const auto& opening : storey.openings)
      if (opening.corrected) mark(mark_place(opening), turn);
    for (const auto& room : storey.rooms) {
      if (!room.corrected) continue;
      const LabelPlace place = label_place(room.polygon, Eigen::Vector2d(20, 15) * mm_, storey.walls);
      const Eigen::Vector2d middle = place.scale > 0 ? place.middle : room.polygon.outline.front();
      mark(middle + Eigen::Rotation2Dd(turn) * Eigen::Vector2d(0, 10 * mm_), turn);
    }
  }

 private:
  void mark(const Eigen::Vector2d& middle, double turn) {
    const Eigen::Rotation2Dd back(turn);
    const double size = correction_mark_size * mm_;
    PlanRing ring;
    for (const auto& corner :
         {Eigen::Vector2d(size, 0), Eigen::Vector2d(0, size), Eigen::Vector2d(-size, 0), Eigen::Vector2d(0, -size)})
      ring.push_back(middle + back * corner);
    drawing_.closed_polyline(revision_layer.name + suffix_, ring);
  }

  void polygons(const std::string& layer, const std::vector<PlanPolygon>& polygons) {
    for (const auto& polygon : polygons) {
      drawing_.closed_polyline(layer + suffix_, polygon.outline);
      for (const auto& hole : polygon.holes) drawing_.closed_polyline(layer + suffix_, hole);
    }
  }

  void slab(const PlanOpening& opening, const PlanStorey& storey) {
    const PlanRing& ring = opening.outline;
    if (ring.size() < 3) return;
    const std::string layer = "A-FLOR-OVHD" + suffix_;
    drawing_.closed_polyline(layer, ring);
    if (ring.size() != 4 || overhead(opening, storey)) return;
    drawing_.line(layer, ring[0], ring[2]);
    drawing_.line(layer, ring[1], ring[3]);
  }

  void window(const PlanOpening& opening) {
    const std::string layer = "A-GLAZ" + suffix_;
    const PlanRing gap = gap_of(opening, hatch_width * mm_);
    drawing_.closed_polyline(layer, gap);
    for (const double share : {0.4, 0.6})
      drawing_.line(layer, gap[0] + share * (gap[3] - gap[0]), gap[1] + share * (gap[2] - gap[1]));
  }

  void door(const PlanOpening& opening, const PlanStorey& storey) {
    const std::string layer = "A-DOOR" + suffix_;
    if (opening.thickness > 0)
      drawing_.closed_polyline(layer, gap_of(opening, 0));
    else
      drawing_.line(layer, opening.from, opening.to);
    for (const auto& leaf : door_leaves(opening, storey)) {
      drawing_.line(layer, leaf.hinge, leaf.open);
      drawing_.arc(layer, leaf.hinge, leaf.left() ? leaf.closed : leaf.open, leaf.left() ? leaf.open : leaf.closed);
    }
  }

  DxfDrawing& drawing_;
  std::string suffix_;
  double mm_;
  Units units_;
};

std::vector<DxfLayer> named(const std::string& suffix) {
  std::vector<DxfLayer> result = layers;
  for (auto& layer : result) layer.name += suffix;
  return result;
}

// What the numbers of the file are: its unit, and the system that they count in.
std::string coordinates_text(Units units, const std::string& crs) {
  const std::string_view unit = units == Units::feet ? "inches" : name_of(units);
  return crs.empty()
             ? fmt::format("coordinates in {} in the frame of the scan", unit)
             : fmt::format("coordinates: {}{}", crs, units == Units::metres ? "" : fmt::format(", in {}", unit));
}

}  // namespace

void WriteDxf::run(const In& in, const Params& params, Context& context) {
  const FloorPlan& plan = *in.plan;
  const std::string crs = crs_of(params.crs, in.scan.get(), plan.to_plan, "plan", context);
  const auto suffix_of = [&](const PlanStorey& storey) {
    return plan.storeys.size() > 1 ? fmt::format("-S{}", storey.index) : std::string();
  };
  std::vector<PlanStorey> storeys;
  std::vector<DxfLayer> all;
  for (const auto& storey : plan.storeys) {
    if (params.storey >= 0 && storey.index != params.storey) continue;
    storeys.push_back(storey);
    const auto more = named(suffix_of(storey));
    all.insert(all.end(), more.begin(), more.end());
    if (!has_corrections(storey)) continue;
    all.push_back(revision_layer);
    all.back().name += suffix_of(storey);
  }
  if (params.storey >= 0 && storeys.empty())
    throw Error(fmt::format("the plan has no storey {}", params.storey),
                fmt::format("it has {}, counted from 0; -1 writes all", plan.storeys.size()));
  if (storeys.empty()) {
    context.warn("the plan is empty: " + params.path.path + " has no entities");
    all = layers;
  }
  Bounds2 view;
  for (const auto& storey : storeys)
    if (const Bounds2 box = bounds(storey); !box.empty()) {
      view.add(box.low);
      view.add(box.high);
    }
  const double turn = wall_turn(plan), mm = params.scale / 1000.0;
  if (!crs.empty()) all.push_back({note_layer, 8, 18});
  DxfDrawing drawing(plan.origin.head<2>(), all, view, {params.units, params.scale});
  drawing.comment("Atrium floor plan; " + coordinates_text(params.units, crs));
  for (const auto& storey : storeys) {
    StoreyDrawing entities(drawing, suffix_of(storey), mm, params.units);
    entities.areas(storey);
    entities.walls(storey);
    entities.openings(storey);
    entities.labels(storey, turn);
    if (params.dimensions) entities.dimensions(storey, turn);
    entities.corrections(storey, turn);
  }
  if (const Bounds2 drawn = drawing.extents(); !crs.empty() && !drawn.empty())
    drawing.text(note_layer, {0.5 * (drawn.low.x() + drawn.high.x()), drawn.low.y() - 6 * mm}, 2.5 * mm,
                 coordinates_text(params.units, crs));
  write_output(context, params.path.path, std::move(drawing).finish());
}

}  // namespace atrium::floorplan
