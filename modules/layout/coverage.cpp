#include "modules/layout/coverage.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "graph/api/error.hpp"
#include "modules/geometry/quantile.hpp"
#include "modules/layout/doorways.hpp"
#include "modules/layout/enclosure.hpp"

namespace atrium::layout {
namespace {

/// Squares of the storey seen from above, finer than the coverage is counted in: the cell of each, which floor and
/// which ceiling it shows, and whether anything stands there.
class Layers {
 public:
  Layers(const Structure& structure, const std::vector<Footprint>& footprints, double pixel, const StoreyCells& storey)
      : fine_(std::max(2, static_cast<int>(std::lround(pixel / (2 * finest)))) * 2), pixel_(pixel / fine_) {
    Eigen::AlignedBox2d box;
    for (const auto& v : storey.vertices) box.extend(v);
    low_ = box.min();
    for (; squares(box) > most_squares && fine_ > 4; pixel_ *= 2) fine_ /= 2;
    if (squares(box) > most_squares)
      throw Error(fmt::format("what may be walls, floors and ceilings of one storey lies {:.0f} m apart: too far to "
                              "look at it in squares of {:.0f} mm",
                              box.sizes().maxCoeff(), 1000 * pixel),
                  "leave out what lies far from the building (filter.crop, filter.outliers), or take larger squares "
                  "(`pixel`)");
    width_ = static_cast<int>(std::ceil(box.sizes().x() / pixel_)) + 1;
    height_ = static_cast<int>(std::ceil(box.sizes().y() / pixel_)) + 1;
    const auto size = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    floor_.assign(size, -1);
    ceiling_.assign(size, -1);
    any_.assign(size, 0);
    cell_.assign(size, -1);
    for (std::size_t c = 0; c < storey.cells.size(); ++c) mark_cell(storey, c);
    paint(structure, footprints, storey.floors, -1, floor_);
    paint(structure, footprints, storey.ceilings, 1, ceiling_);
    fill(*structure.primitives->cloud, storey);
  }

  /// Floor, ceiling and anything within half a square of coverage around a place, as far as it is of the same cell.
  struct Sample {
    std::int32_t floor = -1, ceiling = -1;
    bool any = false;
  };
  Sample around(const Eigen::Vector2d& p, std::int32_t cell) const {
    const int x = column(p.x());
    const int y = row(p.y());
    Sample result;
    for (int v = std::max(0, y - fine_ / 2); v <= std::min(height_ - 1, y + fine_ / 2); ++v)
      for (int u = std::max(0, x - fine_ / 2); u <= std::min(width_ - 1, x + fine_ / 2); ++u) {
        const std::size_t i = index(u, v);
        if (cell_[i] != cell && !(u == x && v == y)) continue;
        if (result.floor < 0) result.floor = floor_[i];
        if (result.ceiling < 0) result.ceiling = ceiling_[i];
        result.any = result.any || any_[i] != 0;
      }
    return result;
  }

 private:
  static constexpr double most_squares = 1 << 27;  // of 13 bytes
  double squares(const Eigen::AlignedBox2d& box) const { return (box.sizes() / pixel_).prod(); }

  static constexpr double finest = 0.0125;  // metres: a tenth of a thin wall

  int column(double x) const { return std::clamp(static_cast<int>((x - low_.x()) / pixel_), 0, width_ - 1); }
  int row(double y) const { return std::clamp(static_cast<int>((y - low_.y()) / pixel_), 0, height_ - 1); }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  bool holds(const Eigen::Vector2d& p) const {
    return p.x() >= low_.x() && p.y() >= low_.y() && p.x() < low_.x() + width_ * pixel_ &&
           p.y() < low_.y() + height_ * pixel_;
  }

  void mark_cell(const StoreyCells& storey, std::size_t c) {
    const LayoutCell& cell = storey.cells[c];
    Eigen::AlignedBox2d box;
    for (const auto v : cell.corners) box.extend(storey.vertices[v]);
    for (int y = row(box.min().y()); y <= row(box.max().y()); ++y)
      for (int x = column(box.min().x()); x <= column(box.max().x()); ++x) {
        const Eigen::Vector2d centre = low_ + Eigen::Vector2d(x + 0.5, y + 0.5) * pixel_;
        if (is_inside(storey.vertices, cell.corners, centre)) cell_[index(x, y)] = static_cast<std::int32_t>(c);
      }
  }

  /// Where several surfaces were seen: the lowest (direction −1) or the highest.
  void paint(const Structure& structure, const std::vector<Footprint>& footprints,
             const std::vector<CellSurface>& surfaces, int direction, std::vector<std::int32_t>& layer) const {
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
      if (surfaces[s].primitive < 0) continue;
      std::vector<std::int32_t> primitives{surfaces[s].primitive};
      primitives.insert(primitives.end(), surfaces[s].joined.begin(), surfaces[s].joined.end());
      for (const auto primitive : primitives)
        paint_one(*structure.primitives, primitive, footprints[static_cast<std::size_t>(primitive)].spacing, surfaces,
                  s, direction, layer);
    }
  }

  /// `spacing`: a surface that is sparser than others covers the squares around its points as well.
  void paint_one(const PlanePrimitives& planes, std::int32_t primitive, double spacing,
                 const std::vector<CellSurface>& surfaces, std::size_t s, int direction,
                 std::vector<std::int32_t>& layer) const {
    const double half = spacing > fine_ * pixel_ ? spacing / 2 : 0;
    for (const auto i : planes.primitives[static_cast<std::size_t>(primitive)].inliers) {
      const Eigen::Vector2d p = planes.cloud->points[i].head<2>().cast<double>();
      if (!holds(p)) continue;
      for (int y = row(p.y() - half); y <= row(p.y() + half); ++y)
        for (int x = column(p.x() - half); x <= column(p.x() + half); ++x) {
          std::int32_t& known = layer[index(x, y)];
          if (known < 0 ||
              direction * (surfaces[s].height_at(p) - surfaces[static_cast<std::size_t>(known)].height_at(p)) > 0)
            known = static_cast<std::int32_t>(s);
        }
    }
  }

  void fill(const Cloud& cloud, const StoreyCells& storey) {
    constexpr double clear = 0.1;
    const auto low = static_cast<float>(storey.floor_height + clear);
    const auto high = static_cast<float>(storey.ceiling_height - clear);
    for (const auto& p : cloud.points) {
      if (p.z() < low || p.z() > high) continue;
      const Eigen::Vector2d place = p.head<2>().cast<double>();
      if (holds(place)) any_[index(column(place.x()), row(place.y()))] = 1;
    }
  }

  int fine_;  ///< squares to a square of coverage, along each side
  double pixel_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  int width_ = 0, height_ = 0;
  std::vector<std::int32_t> cell_, floor_, ceiling_;
  std::vector<std::uint8_t> any_;
};

std::vector<CellCover> shares(const std::map<std::int32_t, int>& counts, int samples) {
  std::vector<CellCover> result;
  result.reserve(counts.size());
  for (const auto& [surface, count] : counts) result.push_back({surface, static_cast<double>(count) / samples});
  return result;
}

/// Whether a wall's line runs along the cell nearer to p than the noise reaches.
bool near_wall(const StoreyCells& storey, const LayoutCell& cell, const Eigen::Vector2d& p, double margin) {
  return std::any_of(cell.edges.begin(), cell.edges.end(), [&](std::uint32_t e) {
    const std::int32_t line = storey.edges[e].line;
    if (line < 0 || storey.lines[static_cast<std::size_t>(line)].primitives.empty()) return false;
    const CellLine& l = storey.lines[static_cast<std::size_t>(line)];
    return std::abs(l.normal.dot(p) + l.offset) < margin;
  });
}

void measure_cell(const Layers& layers, double pixel, double margin, const StoreyCells& storey, std::int32_t index,
                  LayoutCell& cell) {
  Eigen::AlignedBox2d box;
  for (const auto c : cell.corners) box.extend(storey.vertices[c]);
  const double step = std::min(pixel, std::sqrt(cell.area) / 4);
  std::map<std::int32_t, int> floors, ceilings;
  int samples = 0, on_floor = 0, under_ceiling = 0, any = 0;
  for (double y = box.min().y() + step / 2; y < box.max().y(); y += step)
    for (double x = box.min().x() + step / 2; x < box.max().x(); x += step) {
      const Eigen::Vector2d p(x, y);
      if (!is_inside(storey.vertices, cell.corners, p) || near_wall(storey, cell, p, margin)) continue;
      ++samples;
      const Layers::Sample sample = layers.around(p, index);
      if (sample.floor >= 0) {
        ++floors[sample.floor];
        ++on_floor;
      }
      if (sample.ceiling >= 0) {
        ++ceilings[sample.ceiling];
        ++under_ceiling;
      }
      if (sample.any) ++any;
    }
  if (samples == 0) return;
  cell.measured = true;
  cell.floors = shares(floors, samples);
  cell.ceilings = shares(ceilings, samples);
  cell.floor_cover = static_cast<double>(on_floor) / samples;
  cell.ceiling_cover = static_cast<double>(under_ceiling) / samples;
  cell.any_cover = static_cast<double>(any) / samples;
}

/// The height at which a wall before `cell` ends. Where no ceilings were scanned, what looks like one is seldom one.
double ceiling_over(const StoreyCells& storey, bool scanned, std::int32_t cell, const Eigen::Vector2d& p) {
  const CellCover* best = nullptr;
  if (cell >= 0)
    for (const auto& cover : storey.cells[static_cast<std::size_t>(cell)].ceilings)
      if (best == nullptr || cover.share > best->share) best = &cover;
  constexpr double enough = 0.1, most = 0.5;
  if (best == nullptr || best->share < (scanned ? enough : most)) return storey.ceiling_height;
  return storey.ceilings[static_cast<std::size_t>(best->surface)].height_at(p);
}

/// Whether a wall's raster shows a tall face at p: it may end below the ceiling where that was not scanned.
bool is_tall(const Footprint& wall, const Eigen::Vector2d& p, double floor, double ceiling) {
  constexpr double enough = 1, least_share = 0.4;  // metres; of the storey's height
  const Raster& r = wall.raster;
  const int column = r.column(wall.along.dot(p));
  int seen = 0;
  for (int row = std::max(0, r.row(floor)); row < r.height; ++row)
    seen += r.at(column, row) || r.at(column - 1, row) || r.at(column + 1, row) ? 1 : 0;
  return seen * r.pixel >= std::min(enough, least_share * (ceiling - floor));
}

/// Where most columns of a wall end: the highest point of each stands below the wall's end by up to the spacing.
double upper_end(std::vector<double> tops) {
  constexpr double most = 0.8;
  return quantile(std::move(tops), most);
}

/// Where a wall ends over p, at most at the storey's own end; unknown_top: it has no points there.
double top_at(const Footprint& wall, const Eigen::Vector2d& p, const StoreyCells& storey) {
  const int column = wall.raster.column(wall.along.dot(p));
  if (column < 0 || column >= wall.raster.width) return unknown_top;
  const double top = wall.tops[static_cast<std::size_t>(column)];
  return top > storey.floor_height ? std::min(top, storey.high) : unknown_top;
}

/// Walls that begin over one's head: sides of beams and soffits, and what stands over a lower ceiling. They cut cells,
/// so that ceilings can step there, but they end no room. Where most of a scan's walls begin there, it shows no lower
/// part.
std::vector<bool> hanging_walls(const Structure& structure, const std::vector<Footprint>& footprints,
                                const StoreyCells& storey) {
  constexpr double person = 1.8, of_height = 0.8;  // metres; where one stoops
  const double head = std::min(person, of_height * (storey.ceiling_height - storey.floor_height));
  std::vector<bool> hanging(footprints.size(), false);
  double all = 0, above = 0;
  for (const auto& line : storey.lines)
    for (const auto primitive : line.primitives) {
      const auto i = static_cast<std::size_t>(primitive);
      hanging[i] =
          structure.classes[i] == SurfaceClass::wall && footprints[i].raster.low.y() > storey.floor_height + head;
      (hanging[i] ? above : all) += footprints[i].raster.area();
    }
  if (above > all) hanging.assign(footprints.size(), false);
  return hanging;
}

void measure_edge(const Structure& structure, const std::vector<Footprint>& footprints,
                  const std::vector<bool>& hanging, double pixel, bool scanned, const StoreyCells& storey,
                  CellEdge& edge) {
  if (edge.line < 0) return;
  const CellLine& line = storey.lines[static_cast<std::size_t>(edge.line)];
  if (line.primitives.empty()) return;
  const Eigen::Vector2d& a = storey.vertices[edge.from];
  const Eigen::Vector2d& b = storey.vertices[edge.to];
  const Eigen::Vector2d left(a.y() - b.y(), b.x() - a.x());
  const int samples = std::max(1, static_cast<int>(std::ceil((b - a).norm() / pixel)));
  std::vector<double> tops[2];
  for (int i = 0; i < samples; ++i) {
    const Eigen::Vector2d p = a + (b - a) * ((i + 0.5) / samples);
    double seen[2] = {0, 0};
    bool tall[2] = {false, false};
    double top[2] = {unknown_top, unknown_top};
    for (const auto primitive : line.primitives) {
      const auto index = static_cast<std::size_t>(primitive);
      if (hanging[index]) continue;
      const bool looks_left = structure.primitives->primitives[index].plane.normal.head<2>().dot(left) > 0;
      const double ceiling = ceiling_over(storey, scanned, looks_left ? edge.left : edge.right, p);
      const std::size_t side = looks_left ? 0 : 1;
      seen[side] = std::max(seen[side], wall_reach(footprints[index], p, storey.floor_height, ceiling));
      tall[side] = tall[side] || is_tall(footprints[index], p, storey.floor_height, ceiling);
      top[side] = std::max(top[side], top_at(footprints[index], p, storey));
    }
    for (std::size_t side = 0; side < 2; ++side)
      if (top[side] != unknown_top) tops[side].push_back(top[side]);
    edge.face_left += tall[0] ? 1.0 / samples : 0;
    edge.face_right += tall[1] ? 1.0 / samples : 0;
    edge.wall_left += seen[0] / samples;
    edge.wall_right += seen[1] / samples;
  }
  if (!tops[0].empty()) edge.top_left = upper_end(std::move(tops[0]));
  if (!tops[1].empty()) edge.top_right = upper_end(std::move(tops[1]));
}

}  // namespace

double wall_reach(const Footprint& wall, const Eigen::Vector2d& p, double floor, double ceiling) {
  constexpr double gap = 0.05, band = 0.30, enough = 0.6;
  const Raster& r = wall.raster;
  const double top = std::max(ceiling - gap, floor);
  const int column = r.column(wall.along.dot(p));
  const int last = r.row(top - 1e-9);
  const int first = std::min(last, r.row(std::max(floor, top - band)));
  int seen = 0;
  for (int row = first; row <= last; ++row)
    seen += r.at(column, row) || r.at(column - 1, row) || r.at(column + 1, row) ? 1 : 0;
  // Fronts of cupboards end below a ceiling that goes on behind them.
  const bool known = column >= 0 && column < static_cast<int>(wall.open_top.size());
  const double open = known ? wall.open_top[static_cast<std::size_t>(column)] : 0;
  return std::min(1.0, seen / (enough * (last - first + 1))) * (1 - open);
}

bool ceiling_scanned(const StoreyCells& storey) {
  double floor = 0;
  double ceiling = 0;
  for (const auto& cell : storey.cells) {
    floor += cell.area * cell.floor_cover;
    ceiling += cell.area * cell.ceiling_cover;
  }
  constexpr double enough = 0.3;
  return ceiling > enough * floor;
}

double mean_residual(const PlanePrimitives& planes) {
  double sum = 0;
  double points = 0;
  for (const auto& primitive : planes.primitives) {
    sum += primitive.residual * static_cast<double>(primitive.inliers.size());
    points += static_cast<double>(primitive.inliers.size());
  }
  return points > 0 ? sum / points : 0;
}

Eigen::Vector2d middle_of(const StoreyCells& storey, const LayoutCell& cell) {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const auto corner : cell.corners) middle += storey.vertices[corner];
  return middle / static_cast<double>(cell.corners.size());
}

bool is_inside(const std::vector<Eigen::Vector2d>& vertices, const std::vector<std::uint32_t>& corners,
               const Eigen::Vector2d& p) {
  bool inside = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& a = vertices[corners[i]];
    const Eigen::Vector2d& b = vertices[corners[(i + 1) % corners.size()]];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y())) inside = !inside;
  }
  return inside;
}

void measure_coverage(const Structure& structure, const std::vector<Footprint>& footprints, double pixel,
                      StoreyCells& storey) {
  // Beside a wall, noise and drift carry points of the floor through it.
  const double margin = 3 * mean_residual(*structure.primitives);
  const Layers layers(structure, footprints, pixel, storey);
  for (std::size_t c = 0; c < storey.cells.size(); ++c)
    measure_cell(layers, pixel, margin, storey, static_cast<std::int32_t>(c), storey.cells[c]);
  const bool scanned = ceiling_scanned(storey);
  const std::vector<bool> hanging = hanging_walls(structure, footprints, storey);
  for (auto& edge : storey.edges) measure_edge(structure, footprints, hanging, pixel, scanned, storey, edge);
  if (!scanned) close_doorways(storey);
  measure_enclosure(storey);
}

}  // namespace atrium::layout
