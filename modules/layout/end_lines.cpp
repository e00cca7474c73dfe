#include "modules/layout/end_lines.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "modules/layout/enclosure.hpp"

namespace atrium::layout {
namespace {

constexpr double unseen_strip = 0.25;  // metres before a wall

bool any_was_seen(const std::vector<CellSurface>& surfaces) {
  return std::any_of(surfaces.begin(), surfaces.end(), [](const CellSurface& s) { return s.primitive >= 0; });
}

class Ends {
 public:
  Ends(const StoreyPlanes& planes, const std::vector<Footprint>& footprints)
      : planes_(planes), footprints_(footprints) {}

  std::vector<WallLine> run() const {
    std::vector<WallLine> lines;
    for (const auto* surfaces : {&planes_.floors, &planes_.ceilings}) {
      Eigen::AlignedBox2d box;
      each_square(*surfaces, [&](const Eigen::Vector2d& p) { box.extend(p); });
      if (box.isEmpty() || box.sizes().minCoeff() <= 0) continue;
      for (int axis = 0; axis < 2; ++axis)
        for (const double side : {-1.0, 1.0}) {
          const auto place = open_end(*surfaces, axis, side, box);
          if (place && !along_wall(axis, *place, box))
            lines.push_back(line_at(axis, side, end_of_walls(axis, side, *place), box));
        }
    }
    return lines;
  }

 private:
  const Raster& raster(std::int32_t primitive) const { return footprints_[static_cast<std::size_t>(primitive)].raster; }

  /// Where the surfaces end on a side, if mostly not at a wall.
  std::optional<double> open_end(const std::vector<CellSurface>& surfaces, int axis, double side,
                                 const Eigen::AlignedBox2d& box) const {
    constexpr int steps = 64;           // in which the end is looked at
    constexpr double mostly = 0.4;      // of the steps
    constexpr double outermost = 0.02;  // of the steps: stray points lie further out
    std::vector<std::optional<Eigen::Vector2d>> ends(steps + 1);
    each_square(surfaces, [&](const Eigen::Vector2d& p) {
      const double share = (p[1 - axis] - box.min()[1 - axis]) / box.sizes()[1 - axis];
      auto& end = ends[static_cast<std::size_t>(share * steps)];
      if (!end || side * p[axis] > side * (*end)[axis]) end = p;
    });
    std::erase_if(ends, [](const auto& end) { return !end; });
    const auto open = std::count_if(ends.begin(), ends.end(), [&](const auto& p) { return !at_wall(*p); });
    if (static_cast<double>(open) <= mostly * static_cast<double>(ends.size())) return {};
    std::sort(ends.begin(), ends.end(),
              [&](const auto& a, const auto& b) { return side * (*a)[axis] > side * (*b)[axis]; });
    return (*ends[static_cast<std::size_t>(outermost * static_cast<double>(ends.size()))])[axis];
  }

  /// Whether a tall wall runs along this end nearby.
  bool along_wall(int axis, double place, const Eigen::AlignedBox2d& box) const {
    constexpr double parallel = 0.95, near = 0.6, enough = 0.3;  // cosine; metres; of the end's length
    Eigen::Vector2d middle = box.center();
    middle[axis] = place;
    return std::any_of(planes_.lines.begin(), planes_.lines.end(), [&](const WallLine& wall) {
      return std::abs(wall.line.normal[axis]) > parallel && std::abs(wall.line.side(middle)) < near &&
             wall.end - wall.begin > enough * box.sizes()[1 - axis] && is_tall(wall);
    });
  }

  /// The end at `place`, or that of a wall that runs a little further.
  double end_of_walls(int axis, double side, double place) const {
    constexpr double across = 0.3, further = 0.5;  // cosine; metres
    double result = place;
    for (const WallLine& wall : planes_.lines) {
      if (std::abs(wall.line.normal[axis]) > across || !is_tall(wall)) continue;
      const Eigen::Vector2d foot = -wall.line.offset * wall.line.normal;
      for (const double t : {wall.begin, wall.end}) {
        const double end = (foot + t * wall.line.along())[axis];
        if (side * (end - place) < further && side * (end - result) > 0) result = end;
      }
    }
    return result;
  }

  bool is_tall(const WallLine& wall) const {
    const double least_top = least_wall_top(planes_);
    return std::any_of(wall.primitives.begin(), wall.primitives.end(),
                       [&](std::int32_t i) { return raster(i).high().y() >= least_top; });
  }

  /// Whether a tall wall stands near p.
  bool at_wall(const Eigen::Vector2d& p) const {
    constexpr double near = 0.4;  // metres
    return std::any_of(planes_.lines.begin(), planes_.lines.end(), [&](const WallLine& wall) {
      if (std::abs(wall.line.side(p)) > near) return false;
      const double place = wall.line.along().dot(p);
      return place >= wall.begin - near && place <= wall.end + near && is_tall(wall);
    });
  }

  WallLine line_at(int axis, double side, double place, const Eigen::AlignedBox2d& box) const {
    WallLine end;
    end.line.normal = -side * Eigen::Vector2d::Unit(axis);
    end.line.offset =
        side * place + (any_was_seen(planes_.floors) && any_was_seen(planes_.ceilings) ? 0 : unseen_strip);
    const Eigen::Vector2d along = end.line.along();
    end.begin = std::min(along.dot(box.min()), along.dot(box.max()));
    end.end = std::max(along.dot(box.min()), along.dot(box.max()));
    return end;
  }

  /// Calls square(centre) for each square with points of the surfaces.
  template <class Square>
  void each_square(const std::vector<CellSurface>& surfaces, Square square) const {
    for (const auto& s : surfaces) {
      std::vector<std::int32_t> primitives = s.joined;
      if (s.primitive >= 0) primitives.push_back(s.primitive);
      for (const auto primitive : primitives) {
        const Raster& r = raster(primitive);
        for (int y = 0; y < r.height; ++y)
          for (int x = 0; x < r.width; ++x)
            if (r.at(x, y)) square(r.centre(x, y));
      }
    }
  }

  const StoreyPlanes& planes_;
  const std::vector<Footprint>& footprints_;
};

}  // namespace

std::vector<WallLine> end_lines(const StoreyPlanes& planes, const std::vector<Footprint>& footprints) {
  return Ends(planes, footprints).run();
}

}  // namespace atrium::layout
