#include "modules/layout/covered_floor.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "modules/layout/face_grid.hpp"

namespace atrium::layout {
namespace {

constexpr double least_square = 0.25;   // metres
constexpr double least_headroom = 1.8;  // metres
constexpr double highest = 20;          // metres
constexpr double enough = 0.6;          // of the height that a room must have
constexpr double least_piece = 2;       // square metres
constexpr double lies_up = 0.9;         // cosine
constexpr double faces_down = 0.5;      // cosine: ceilings may be slopes of up to 60 degrees

struct CoveredLevel {
  float z;
  bool up;
};
struct Span {
  double low, high;
};

class CoveredSquares {
 public:
  CoveredSquares(const Building& building, const PlanePrimitives& planes) : building_(building), planes_(planes) {
    Eigen::AlignedBox2d box;
    for (const auto& primitive : planes.primitives)
      if (is_level(primitive))
        for (const auto i : primitive.inliers) box.extend(planes.cloud->points[i].head<2>().cast<double>().eval());
    if (box.isEmpty()) return;
    low_ = box.min();
    edge_ = std::max(least_square, box.sizes().maxCoeff() / 4000);
    width_ = static_cast<int>(box.sizes().x() / edge_) + 1;
    height_ = static_cast<int>(box.sizes().y() / edge_) + 1;
    levels_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    rooms_.resize(levels_.size());
    missing_.assign(levels_.size(), 0);
    floors_.resize(levels_.size());
    for (const auto& primitive : planes.primitives)
      if (is_level(primitive)) add(primitive);
    for (const auto& room : building.rooms) add(room);
  }

  CoveredFloor run() {
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      floors_[i] = floor_without_room(levels_[i], rooms_[i]);
      missing_[i] = floors_[i] ? 1 : 0;
    }
    CoveredFloor result;
    for (std::size_t i = 0; i < missing_.size(); ++i) {
      if (missing_[i] != 1) continue;
      const Piece piece = take(i);
      if (!piece.wide || piece.area < least_piece) continue;
      result.missing += piece.area;
      if (piece.area <= result.largest) continue;
      result.largest = piece.area;
      result.where = piece.where;
    }
    return result;
  }

 private:
  struct Piece {
    double area = 0;
    bool wide = false;  // a block of 3 x 3 squares is in it
    Eigen::Vector3d where = Eigen::Vector3d::Zero();
  };

  static bool is_level(const PlanePrimitive& primitive) {
    const double z = primitive.plane.normal.z();
    return z > lies_up || z < -faces_down;
  }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  Eigen::Vector2d centre(int x, int y) const { return low_ + edge_ * Eigen::Vector2d(x + 0.5, y + 0.5); }

  /// The mean height of the primitive's points in each square with at least two.
  void add(const PlanePrimitive& primitive) {
    struct Mean {
      double sum = 0;
      int count = 0;
    };
    Eigen::AlignedBox2i box;
    const auto square = [&](const Eigen::Vector3d& p) -> Eigen::Vector2i {
      return ((p.head<2>() - low_) / edge_).cast<int>();
    };
    const auto point = [&](std::uint32_t i) -> Eigen::Vector3d { return planes_.cloud->points[i].cast<double>(); };
    for (const auto i : primitive.inliers) box.extend(square(point(i)));
    if (box.isEmpty()) return;
    const int width = box.sizes().x() + 1;
    std::vector<Mean> means(static_cast<std::size_t>(width) * static_cast<std::size_t>(box.sizes().y() + 1));
    for (const auto i : primitive.inliers) {
      const Eigen::Vector3d p = point(i);
      const Eigen::Vector2i at = square(p) - box.min();
      Mean& mean =
          means[static_cast<std::size_t>(at.y()) * static_cast<std::size_t>(width) + static_cast<std::size_t>(at.x())];
      mean.sum += p.z();
      ++mean.count;
    }
    for (std::size_t i = 0; i < means.size(); ++i) {
      if (means[i].count < 2) continue;
      const int x = box.min().x() + static_cast<int>(i) % width, y = box.min().y() + static_cast<int>(i) / width;
      levels_[index(x, y)].push_back(
          {static_cast<float>(means[i].sum / means[i].count), primitive.plane.normal.z() > 0});
    }
  }

  void add(const BuildingRoom& room) {
    std::vector<std::vector<Eigen::Vector2d>> rings(1);
    for (const auto& p : room.outline) rings[0].emplace_back(p.head<2>());
    Eigen::AlignedBox2d box;
    for (const auto& p : rings[0]) box.extend(p);
    Span span{1e300, -1e300};
    for (const auto f : room.faces)
      for (const auto v : building_.faces[static_cast<std::size_t>(f)].outline)
        span = {std::min(span.low, building_.vertices[v].z()), std::max(span.high, building_.vertices[v].z())};
    if (box.isEmpty()) return;
    const Eigen::Vector2i first = ((box.min() - low_) / edge_).array().floor().cast<int>().max(0);
    const Eigen::Vector2i last =
        ((box.max() - low_) / edge_).array().floor().cast<int>().min(Eigen::Array2i(width_ - 1, height_ - 1));
    for (int y = first.y(); y <= last.y(); ++y)
      for (int x = first.x(); x <= last.x(); ++x)
        if (inside_rings(rings, centre(x, y))) rooms_[index(x, y)].push_back(span);
  }

  /// The height of a floor if it and the next ceiling over it, further apart than a person is high, are in no room.
  static std::optional<double> floor_without_room(std::vector<CoveredLevel>& levels, const std::vector<Span>& rooms) {
    std::sort(levels.begin(), levels.end(), [](const CoveredLevel& a, const CoveredLevel& b) { return a.z < b.z; });
    for (std::size_t c = 0; c < levels.size(); ++c) {
      if (levels[c].up) continue;
      // The lowest floor since the last ceiling: what stands on it is furniture.
      double floor = 1e300;
      for (std::size_t f = 0; f < c; ++f) {
        const bool lower = levels[f].up ? levels[f].z < floor : false;
        if (!levels[f].up && floor < 1e300 && levels[f].z - floor > least_headroom) floor = 1e300;
        if (lower) floor = levels[f].z;
      }
      const double between = levels[c].z - floor;
      if (!(between >= least_headroom) || between > highest) continue;
      const bool held = std::any_of(rooms.begin(), rooms.end(), [&](const Span& room) {
        return std::min<double>(room.high, levels[c].z) - std::max(room.low, floor) >= enough * between;
      });
      if (!held) return floor;
    }
    return {};
  }

  /// The connected piece that a missing square is part of; its squares are marked as taken.
  Piece take(std::size_t first) {
    Piece piece;
    std::vector<std::size_t> open{first};
    missing_[first] = 2;
    for (std::size_t k = 0; k < open.size(); ++k) {
      const int x = static_cast<int>(open[k] % static_cast<std::size_t>(width_));
      const int y = static_cast<int>(open[k] / static_cast<std::size_t>(width_));
      int around = 0;
      for (int v = std::max(0, y - 1); v <= std::min(height_ - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(width_ - 1, x + 1); ++u) {
          around += missing_[index(u, v)] != 0 ? 1 : 0;
          if (missing_[index(u, v)] != 1) continue;
          missing_[index(u, v)] = 2;
          open.push_back(index(u, v));
        }
      if (around == 9 && !piece.wide) {
        piece.wide = true;
        piece.where << centre(x, y), floors_[open[k]].value_or(0);
      }
    }
    piece.area = static_cast<double>(open.size()) * edge_ * edge_;
    return piece;
  }

  const Building& building_;
  const PlanePrimitives& planes_;
  Eigen::Vector2d low_ = Eigen::Vector2d::Zero();
  double edge_ = least_square;
  int width_ = 0, height_ = 0;
  std::vector<std::vector<CoveredLevel>> levels_;
  std::vector<std::vector<Span>> rooms_;
  std::vector<std::optional<double>> floors_;  // of what is missing
  std::vector<std::uint8_t> missing_;          // 1: missing, 2: missing and taken
};

}  // namespace

CoveredFloor covered_floor_without_room(const Building& building, const PlanePrimitives& planes) {
  return CoveredSquares(building, planes).run();
}

}  // namespace atrium::layout
