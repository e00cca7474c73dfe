#include "modules/geometry/upright_axes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "modules/geometry/symmetric_eigen.hpp"

namespace atrium {
namespace {

constexpr double radians = std::numbers::pi / 180.0;

/// Degrees from level (0: the normal is along the axis) and from upright (0: across it).
struct Lean {
  double from_level, from_upright;
};
Lean lean_of(const Eigen::Vector3d& normal, const Eigen::Vector3d& axis) {
  const double level = std::acos(std::min(1.0, std::abs(normal.dot(axis)))) / radians;
  return {level, 90.0 - level};
}

double support_of(const std::vector<FacedArea>& faces, const Eigen::Vector3d& axis) {
  constexpr double close = 5;
  double sum = 0, all = 0;
  for (const auto& face : faces) {
    const Lean lean = lean_of(face.normal, axis);
    all += face.area;
    if (std::min(lean.from_level, lean.from_upright) < close) sum += face.area;
  }
  return all > 0 ? sum / all : 0;
}

/// The normals of the most area, none within 20 degrees of another.
std::vector<Eigen::Vector3d> main_normals(const std::vector<FacedArea>& faces, std::size_t most) {
  std::vector<FacedArea> clusters;
  constexpr double apart = 20;
  for (const auto& face : faces) {
    auto near = std::find_if(clusters.begin(), clusters.end(),
                             [&](const FacedArea& c) { return lean_of(face.normal, c.normal).from_level < apart; });
    if (near == clusters.end())
      clusters.push_back(face);
    else
      near->area += face.area;
  }
  std::stable_sort(clusters.begin(), clusters.end(), [](const auto& a, const auto& b) { return a.area > b.area; });
  std::vector<Eigen::Vector3d> result;
  for (const auto& c : clusters)
    if (result.size() < most) result.push_back(c.normal);
  return result;
}

/// Area that is level or upright as seen along an axis, the less the further it is from that (3 degrees: nothing).
double agreement(const std::vector<FacedArea>& faces, const Eigen::Vector3d& axis) {
  constexpr double width = 3;
  double sum = 0;
  for (const auto& face : faces) {
    const double c = std::min(1.0, std::abs(face.normal.dot(axis)));
    const double sine = c > 0.7 ? std::sqrt(1 - c * c) : c;  // of the angle from level or from upright
    const double x = std::asin(std::min(1.0, sine)) / (width * radians);
    if (x < 1) sum += face.area * (1 - x * x) * (1 - x * x);
  }
  return sum;
}

/// Where the search for a vertical near `start` begins: of `start`, the normals near it and the cross products of walls
/// the one that most area agrees with.
Eigen::Vector3d best_start(const std::vector<FacedArea>& faces, const Eigen::Vector3d& start, double widest) {
  std::vector<FacedArea> levels, walls;
  for (const auto& face : faces) {
    const Lean lean = lean_of(face.normal, start);
    if (lean.from_level < widest) levels.push_back(face);
    if (lean.from_upright < widest) walls.push_back(face);
  }
  const auto largest = [](std::vector<FacedArea>& list, std::size_t most) {
    std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.area > b.area; });
    if (list.size() > most) list.resize(most);
  };
  largest(levels, 12);
  largest(walls, 8);
  std::vector<Eigen::Vector3d> tries{start};
  for (const auto& level : levels) tries.push_back(level.normal);
  for (std::size_t i = 0; i < walls.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Eigen::Vector3d cross = walls[i].normal.cross(walls[j].normal);
      constexpr double oblique = 0.5;  // sine of the angle between two walls that tell the vertical
      if (cross.norm() > oblique && lean_of(cross.normalized(), start).from_level < widest)
        tries.push_back(cross.normalized());
    }
  Eigen::Vector3d best = start;
  double most = -1;
  for (const auto& axis : tries) {
    const double area = agreement(faces, axis);
    if (area <= most * 1.0001) continue;
    most = area;
    best = axis.dot(start) < 0 ? Eigen::Vector3d(-axis) : axis;
  }
  return best;
}

}  // namespace

Eigen::Vector3d refined_vertical(const std::vector<FacedArea>& faces, const Eigen::Vector3d& start, double widest) {
  Eigen::Vector3d axis = best_start(faces, start.normalized(), widest);
  constexpr double narrowest = 0.5, broadest = 4.0;
  constexpr int rounds = 10;
  for (int i = 0; i < rounds; ++i) {
    const double width = std::max(narrowest, broadest * std::pow(0.75, i));
    Eigen::Matrix3d cost = Eigen::Matrix3d::Zero();
    for (const auto& face : faces) {
      const Lean lean = lean_of(face.normal, axis);
      const double x = std::min(lean.from_level, lean.from_upright) / width;
      if (x >= 1) continue;
      // In the end large planes count for more: a plane's normal is known the better the more points it has and the
      // further apart they are.
      const double certainty = i < rounds / 2 ? face.area : face.area * face.area;
      const double weight = certainty * (1 - x * x) * (1 - x * x);
      const Eigen::Matrix3d along = face.normal * face.normal.transpose();
      cost += weight * (lean.from_level < lean.from_upright ? Eigen::Matrix3d::Identity() - along : along);
    }
    if (!(cost.trace() > 0)) continue;
    // Where all votes leave a choice (walls of one direction), the nearest to the axis so far.
    constexpr double least = 1e-6;
    cost += least * cost.trace() * (Eigen::Matrix3d::Identity() - axis * axis.transpose());
    const Eigen::Vector3d next = symmetric_eigen(cost).vectors.col(0);
    axis = next.dot(axis) < 0 ? Eigen::Vector3d(-next) : next;
  }
  return axis;
}

std::vector<UprightAxis> upright_axes(const std::vector<FacedArea>& faces) {
  std::vector<Eigen::Vector3d> starts{Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitX()};
  const auto normals = main_normals(faces, 6);
  starts.insert(starts.end(), normals.begin(), normals.end());
  for (std::size_t i = 0; i < std::min<std::size_t>(3, normals.size()); ++i)
    for (std::size_t j = 0; j < i; ++j) starts.push_back(normals[i].cross(normals[j]).normalized());
  std::vector<UprightAxis> result;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    constexpr double of_frame = 15, of_normals = 10, same = 10;
    const Eigen::Vector3d axis = refined_vertical(faces, starts[i], i < 3 ? of_frame : of_normals);
    const auto known = [&](const UprightAxis& a) { return lean_of(axis, a.direction).from_level < same; };
    if (std::none_of(result.begin(), result.end(), known)) result.push_back({axis, support_of(faces, axis)});
  }
  return result;
}

}  // namespace atrium
