#include "modules/floorplan/sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "graph/api/error.hpp"
#include "modules/floorplan/sheet_grid.hpp"

namespace atrium::floorplan {
namespace {

constexpr double least_building = 25;  // millimetres: smaller ones are drawn only if there is no other way
constexpr std::array<int, 10> scales{50, 100, 200, 500, 1000, 2000, 5000, 10000, 20000, 50000};

struct Format {
  std::string_view name;
  Paper paper;
  double width, height;
};
constexpr std::array<Format, 5> formats{{{"A4", Paper::a4, 210, 297},
                                         {"A3", Paper::a3, 297, 420},
                                         {"A2", Paper::a2, 420, 594},
                                         {"A1", Paper::a1, 594, 841},
                                         {"A0", Paper::a0, 841, 1189}}};

// What is around the drawings: the margins and the title block.
Eigen::Vector2d edges() { return {2 * frame_margin, 2 * frame_margin + title_height}; }

// The storeys as they are drawn at one scale.
struct Drawings {
  int scale = 0;
  Units units = Units::metres;
  double building = 0;                 // greatest extent of a storey, millimetres of paper
  std::vector<Bounds2> boxes;          // metres, captions included
  std::vector<Eigen::Vector2d> sizes;  // millimetres of paper
  std::vector<Caption> captions;
};

Drawings drawings_of(const std::vector<PlanStorey>& storeys, double origin_z, int scale, Units units) {
  Drawings result{scale, units, 0, {}, {}, {}};
  const double mm = scale / 1000.0;
  for (const auto& storey : storeys) {
    Bounds2 box = drawing_bounds(storey, mm, units);
    const Bounds2 building = bounds(storey);
    Caption caption = caption_of(storey, origin_z, units);
    const double left = building.empty() ? box.low.x() : building.low.x();
    caption.stacked = left + caption.width() * mm > box.high.x();
    box.high.x() = std::max(box.high.x(), left + caption.width() * mm);
    box.high.y() += caption.height() * mm;
    result.building = std::max(result.building, building.size().maxCoeff() / mm);
    result.sizes.emplace_back(box.size() / mm);
    result.boxes.push_back(box);
    result.captions.push_back(std::move(caption));
  }
  return result;
}

// Lays the drawings out on a sheet of the given size; false if they do not fit.
bool lay_out(Sheet& sheet, const Drawings& drawings, std::size_t columns) {
  const Eigen::Vector2d room = sheet.size - edges();
  const SheetGrid grid(drawings.sizes, columns);
  if ((grid.need().array() > room.array()).any()) return false;
  sheet.scale = drawings.scale;
  sheet.units = drawings.units;
  sheet.captions = drawings.captions;
  sheet.places.clear();
  for (std::size_t i = 0; i < drawings.boxes.size(); ++i) {
    const Bounds2& box = drawings.boxes[i];
    const Eigen::Vector2d corner =
        grid.corner(i, drawings.sizes[i], room) + Eigen::Vector2d(frame_margin, frame_margin);
    sheet.places.emplace_back(corner - sheet.per_metre() * Eigen::Vector2d(box.low.x(), -box.high.y()));
  }
  return true;
}

// In a row or a column if there is room for that, lying or upright; else in a grid.
bool fits(Sheet& sheet, const Format& format, const Drawings& drawings) {
  sheet.paper = format.name;
  const auto columns = column_counts(drawings.boxes.size());
  const std::span all(columns);
  for (const auto& tried : {all.first(2), all.subspan(2)})
    for (const bool landscape : {true, false}) {
      sheet.size =
          landscape ? Eigen::Vector2d(format.height, format.width) : Eigen::Vector2d(format.width, format.height);
      for (const std::size_t count : tried)
        if (lay_out(sheet, drawings, count)) return true;
    }
  return false;
}

// On a lying sheet as large as it takes, in whole centimetres, of about the proportions of the A formats.
Sheet on_custom_paper(const Drawings& drawings) {
  Sheet sheet;
  double least = std::numeric_limits<double>::infinity();
  std::size_t best = 1;
  for (const std::size_t count : column_counts(drawings.boxes.size())) {
    const Eigen::Vector2d need = SheetGrid(drawings.sizes, count).need() + edges();
    const double reach = std::max(need.x() / std::sqrt(2.0), need.y());
    if (reach >= least) continue;
    least = reach;
    best = count;
    sheet.size = 10 * ((need.array() + 1) / 10).ceil();
  }
  sheet.size = sheet.size.cwiseMax(Eigen::Vector2d(297, 210));  // the title block wants room, too
  sheet.paper = custom_paper(sheet.size);
  lay_out(sheet, drawings, best);
  return sheet;
}

bool on_any(Sheet& sheet, std::span<const Format> papers, std::span<const Drawings> drawings) {
  for (const auto& candidate : drawings)
    for (const auto& format : papers)
      if (fits(sheet, format, candidate)) return true;
  return false;
}

Sheet on_automatic_paper(std::span<const Drawings> drawings) {
  const std::span<const Format> all(formats);
  // The greatest scale is never too small, whatever the building.
  const auto small =
      std::find_if(drawings.begin() + 1, drawings.end(), [](const Drawings& d) { return d.building < least_building; });
  const auto legible = drawings.first(static_cast<std::size_t>(small - drawings.begin()));
  Sheet sheet;
  for (const auto& papers : {all.first(2), all.subspan(2, 1), all.subspan(3, 1), all.subspan(4, 1)})
    if (on_any(sheet, papers, legible)) return sheet;
  return on_custom_paper(legible.back());
}

[[noreturn]] void fail(const Format& given, std::span<const Drawings> drawings) {
  Sheet sheet;
  const auto larger = std::span<const Format>(formats).subspan(static_cast<std::size_t>(&given - formats.data()) + 1);
  for (const auto& format : larger)
    if (on_any(sheet, {&format, 1}, drawings))
      throw Error(fmt::format("the plan does not fit on {} at 1:{}", given.name, drawings.back().scale),
                  fmt::format("{} has room for it at 1:{}; or leave `paper` auto, give a smaller `scale` (a larger "
                              "number; 0 chooses one), or one `storey` only",
                              sheet.paper, sheet.scale));
  sheet = on_custom_paper(drawings.back());
  throw Error(
      fmt::format("the plan does not fit on {} at 1:{}", given.name, sheet.scale),
      fmt::format("it takes {}: leave `paper` auto; or give a smaller `scale` (a larger number; 0 chooses one), "
                  "or one `storey` only",
                  sheet.paper));
}

}  // namespace

std::optional<Paper> paper_named(std::string_view name) {
  for (const auto& format : formats)
    if (format.name == name) return format.paper;
  return {};
}

std::string custom_paper(const Eigen::Vector2d& size) {
  return fmt::format("{:.0f} \u00D7 {:.0f} mm", size.x(), size.y());
}

Bounds2 drawing_bounds(const PlanStorey& storey, double mm, Units units) {
  Bounds2 box = bounds(storey);
  if (box.empty()) box.low = box.high = Eigen::Vector2d::Zero();
  for (const auto& chain : dimensions_of(storey, mm, units)) {
    box.add(chain.at(chain.stops.front(), chain.line));
    for (const auto& label : chain.labels) {
      const double half = 0.5 * text_width(label.text, label.height);
      const Eigen::Vector2d reach =
          label.upwards ? Eigen::Vector2d(label.height, half) : Eigen::Vector2d(half, label.height);
      box.add(label.middle - reach);
      box.add(label.middle + reach);
    }
  }
  return box;
}

Sheet arranged(const std::vector<PlanStorey>& storeys, double origin_z, Paper paper, int scale, Units units) {
  std::vector<Drawings> drawings;
  if (scale > 0)
    drawings.push_back(drawings_of(storeys, origin_z, scale, units));
  else
    for (const int usual : scales) drawings.push_back(drawings_of(storeys, origin_z, usual, units));
  if (paper == Paper::automatic) {
    if (scale == 0) return on_automatic_paper(drawings);
    Sheet sheet;
    return on_any(sheet, formats, drawings) ? sheet : on_custom_paper(drawings.front());
  }
  const auto given = std::find_if(formats.begin(), formats.end(), [&](const Format& f) { return f.paper == paper; });
  Sheet sheet;
  if (!on_any(sheet, {&*given, 1}, drawings)) fail(*given, drawings);
  return sheet;
}

}  // namespace atrium::floorplan
