#include "modules/floorplan/sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "graph/api/error.hpp"

namespace atrium::floorplan {
namespace {

constexpr double around = 7;  // millimetres between drawings, and to the frame
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

// Lays the boxes out in a row or a column in the middle of the free part of the paper; false if they do not fit.
bool lay_out(Sheet& sheet, const std::vector<Bounds2>& boxes, bool row) {
  const int main = row ? 0 : 1;
  const Eigen::Vector2d room = sheet.size - Eigen::Vector2d(2 * frame_margin, 2 * frame_margin + title_height);
  Eigen::Vector2d need = Eigen::Vector2d::Constant(around);
  for (const auto& box : boxes) {
    const Eigen::Vector2d size = box.size() * sheet.per_metre();
    need[main] += size[main] + around;
    need[1 - main] = std::max(need[1 - main], size[1 - main] + 2 * around);
  }
  if ((need.array() > room.array()).any()) return false;
  // What is left over is shared out between and around.
  const double spare = (room[main] - need[main]) / static_cast<double>(boxes.size() + 1) + around;
  double at = frame_margin;
  sheet.places.assign(boxes.size(), Eigen::Vector2d::Zero());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const std::size_t storey = row ? i : boxes.size() - 1 - i;  // the lowest on the left, or at the bottom
    const Bounds2& box = boxes[storey];
    const Eigen::Vector2d size = box.size() * sheet.per_metre();
    Eigen::Vector2d corner;
    corner[main] = at + spare;
    corner[1 - main] = frame_margin + 0.5 * (room[1 - main] - size[1 - main]);
    at += spare + size[main];
    sheet.places[storey] = corner - sheet.per_metre() * Eigen::Vector2d(box.low.x(), -box.high.y());
  }
  return true;
}

bool fits(Sheet& sheet, const Format& format, const std::vector<Bounds2>& boxes) {
  sheet.paper = format.name;
  for (const bool landscape : {true, false}) {
    sheet.size =
        landscape ? Eigen::Vector2d(format.height, format.width) : Eigen::Vector2d(format.width, format.height);
    for (const bool row : {true, false})
      if (lay_out(sheet, boxes, row)) return true;
  }
  return false;
}

}  // namespace

Bounds2 drawing_bounds(const PlanStorey& storey, double mm) {
  Bounds2 box = bounds(storey);
  if (box.empty()) box.low = box.high = Eigen::Vector2d::Zero();
  for (const auto& chain : dimensions_of(storey, mm)) {
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

Sheet arranged(const std::vector<PlanStorey>& storeys, Paper paper, int scale) {
  Sheet sheet;
  for (const int candidate : scales) {
    sheet.scale = scale > 0 ? scale : candidate;
    std::vector<Bounds2> boxes;
    for (const auto& storey : storeys) {
      boxes.push_back(drawing_bounds(storey, sheet.scale / 1000.0));
      boxes.back().high.y() += caption_height * sheet.scale / 1000.0;
    }
    for (const auto& format : formats) {
      if (paper != Paper::automatic && paper != format.paper) continue;
      if (paper == Paper::automatic && scale == 0 && format.paper > Paper::a3) continue;
      if (fits(sheet, format, boxes)) return sheet;
    }
    if (scale > 0) break;
  }
  throw Error(
      fmt::format("the plan does not fit on {} at 1:{}", paper == Paper::automatic ? "A0" : sheet.paper, sheet.scale),
      "give a larger `paper`, a smaller `scale` (a larger number; 0 chooses one), or one `storey` only");
}

}  // namespace atrium::floorplan
