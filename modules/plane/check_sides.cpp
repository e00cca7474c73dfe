#include "modules/plane/check_sides.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "graph/api/text.hpp"

namespace atrium::plane {
namespace {

constexpr double level_cosine = 0.9994;  // of 2° from z
constexpr double upright_sine = 0.1;     // a smaller z of the normal

bool lies_level(const PlanePrimitive& p) { return std::abs(p.plane.normal.z()) >= level_cosine; }
bool stands_upright(const PlanePrimitive& p) { return std::abs(p.plane.normal.z()) <= upright_sine; }

struct LevelPlane {
  std::size_t primitive = 0;
  double height = 0;
  double points = 0;
  bool up = false;
};

std::vector<LevelPlane> level_planes(const PlanePrimitives& planes) {
  std::vector<LevelPlane> result;
  for (std::size_t i = 0; i < planes.primitives.size(); ++i) {
    const PlanePrimitive& p = planes.primitives[i];
    if (p.inliers.empty() || !lies_level(p)) continue;
    double height = 0;
    for (const auto k : p.inliers) height += static_cast<double>(planes.cloud->points[k].z());
    const auto points = static_cast<double>(p.inliers.size());
    result.push_back({i, height / points, points, p.plane.normal.z() > 0});
  }
  return result;
}

using Boxes = std::vector<Eigen::AlignedBox3f>;

/// Of the points of each upright plane; empty for others.
Boxes boxes_of_walls(const PlanePrimitives& planes) {
  Boxes boxes(planes.primitives.size());
  for (std::size_t i = 0; i < boxes.size(); ++i)
    if (stands_upright(planes.primitives[i]))
      for (const auto k : planes.primitives[i].inliers) boxes[i].extend(planes.cloud->points[k]);
  return boxes;
}

/// Of the points of upright planes over and under a level plane, the share on the side that it does not look to; 0
/// if there are none.
double walls_behind(const PlanePrimitives& planes, const LevelPlane& own, const Boxes& walls) {
  constexpr float around = 0.1F;                    // metres: of the walls from its bounding box
  constexpr float nearest = 0.1F, furthest = 1.0F;  // metres: of a wall's points from its height
  const auto& points = planes.cloud->points;
  Eigen::AlignedBox2f box;
  for (const auto k : planes.primitives[own.primitive].inliers) box.extend(points[k].head<2>());
  box.min().array() -= around;
  box.max().array() += around;
  const auto height = static_cast<float>(own.height);
  const Eigen::AlignedBox3f near(Eigen::Vector3f(box.min().x(), box.min().y(), height - furthest),
                                 Eigen::Vector3f(box.max().x(), box.max().y(), height + furthest));
  std::size_t over = 0, under = 0;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (!walls[i].intersects(near)) continue;
    for (const auto k : planes.primitives[i].inliers) {
      const float off = points[k].z() - height;
      if (std::abs(off) < nearest || std::abs(off) > furthest || !box.contains(points[k].head<2>())) continue;
      ++(off > 0 ? over : under);
    }
  }
  if (over + under == 0) return 0;
  return static_cast<double>(own.up ? under : over) / static_cast<double>(over + under);
}

/// Squares of 10 cm seen from above that level planes have points in, each with the heights of floors and of ceilings.
class Levels {
 public:
  explicit Levels(const PlanePrimitives& planes) {
    for (const auto& p : planes.primitives) {
      if (p.inliers.empty() || !lies_level(p)) continue;
      for (const auto k : p.inliers) {
        const Eigen::Vector3f& point = planes.cloud->points[k];
        Heights& heights = squares_[key(point.head<2>().cast<double>())];
        add(p.plane.normal.z() > 0 ? heights.floors : heights.ceilings, point.z());
      }
    }
  }
  /// Whether the next level surface under the place looks up and the next one over it looks down, both within a
  /// storey's height.
  bool is_room(const Eigen::Vector3d& place) const {
    constexpr float storey = 4, off = 0.05F;  // metres
    const auto found = squares_.find(key(place.head<2>()));
    if (found == squares_.end()) return false;
    const auto z = static_cast<float>(place.z());
    const auto next = [z](const std::vector<float>& heights, float sign) {
      float nearest = storey;
      for (const float h : heights)
        if (sign * (h - z) > off) nearest = std::min(nearest, sign * (h - z));
      return nearest;
    };
    const Heights& heights = found->second;
    return next(heights.floors, -1) < next(heights.ceilings, -1) && next(heights.ceilings, 1) < next(heights.floors, 1);
  }

 private:
  struct Heights {
    std::vector<float> floors, ceilings;  // those that differ by less than 5 cm once
  };
  static void add(std::vector<float>& heights, float z) {
    constexpr float same = 0.05F;
    if (std::none_of(heights.begin(), heights.end(), [z](float h) { return std::abs(h - z) < same; }))
      heights.push_back(z);
  }
  static std::uint64_t key(const Eigen::Vector2d& p) {
    constexpr double edge = 0.1;
    const auto x = static_cast<std::int32_t>(std::floor(p.x() / edge));
    const auto y = static_cast<std::int32_t>(std::floor(p.y() / edge));
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32U | static_cast<std::uint32_t>(y);
  }
  std::unordered_map<std::uint64_t, Heights> squares_;
};

/// Cubes of 10 cm, each with the upright planes that have points in it.
class Walls {
 public:
  explicit Walls(const PlanePrimitives& planes) {
    for (std::size_t i = 0; i < planes.primitives.size(); ++i) {
      if (!stands_upright(planes.primitives[i])) continue;
      for (const auto k : planes.primitives[i].inliers) {
        auto& known = cubes_[key(planes.cloud->points[k].cast<double>())];
        if (known.empty() || known.back() != i) known.push_back(static_cast<std::uint32_t>(i));
      }
    }
  }
  /// Whether another upright plane stands in that direction, nearer than walls are thick.
  bool are_near(std::size_t own, const Eigen::Vector3d& place, const Eigen::Vector3d& direction) const {
    constexpr double thinnest = 0.05, thickest = 0.8;  // metres
    for (double at = thinnest; at < thickest; at += edge / 2) {
      const auto found = cubes_.find(key(place + at * direction));
      if (found != cubes_.end() && (found->second.size() > 1 || found->second.front() != own)) return true;
    }
    return false;
  }

 private:
  static constexpr double edge = 0.1;
  static std::uint64_t key(const Eigen::Vector3d& p) {
    constexpr std::uint64_t mask = (1U << 21U) - 1;  // 200 km
    const Eigen::Vector3d q = (p / edge).array().floor();
    return (static_cast<std::uint64_t>(static_cast<std::int64_t>(q.x())) & mask) << 42U |
           (static_cast<std::uint64_t>(static_cast<std::int64_t>(q.y())) & mask) << 21U |
           (static_cast<std::uint64_t>(static_cast<std::int64_t>(q.z())) & mask);
  }
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cubes_;
};

/// Whether there are rooms behind an upright plane, and before it the inside of a wall.
bool has_rooms_behind(const PlanePrimitives& planes, std::size_t index, const Levels& levels, const Walls& walls,
                      double inside) {
  constexpr std::size_t most_places = 64;
  constexpr double step = 0.15;       // metres: less than a partition and the room behind it
  constexpr double hardly_any = 0.1;  // of the places
  const PlanePrimitive& wall = planes.primitives[index];
  const std::size_t stride = std::max<std::size_t>(1, wall.inliers.size() / most_places);
  double places = 0, before = 0, behind = 0, near = 0;
  for (std::size_t k = stride / 2; k < wall.inliers.size(); k += stride) {
    const Eigen::Vector3d p = planes.cloud->points[wall.inliers[k]].cast<double>();
    ++places;
    before += levels.is_room(p + step * wall.plane.normal) ? 1 : 0;
    behind += levels.is_room(p - step * wall.plane.normal) ? 1 : 0;
    near += walls.are_near(index, p, wall.plane.normal) ? 1 : 0;
  }
  return behind >= inside * places && near >= inside * places && before <= hardly_any * places;
}

void turn(Plane& plane) { plane = {-plane.normal, -plane.offset}; }

std::size_t turn_levels(PlanePrimitives& planes, const CheckSides::Params& params, const Context& context) {
  constexpr double mostly = 0.8;  // of the walls' points around
  const std::vector<LevelPlane> all = level_planes(planes);
  const Boxes walls = boxes_of_walls(planes);
  std::vector<std::size_t> wrong;
  for (const LevelPlane& own : all) {
    context.check_cancelled();
    double same = own.points, other = 0;
    for (const LevelPlane& p : all)
      if (p.primitive != own.primitive && std::abs(p.height - own.height) < params.apart)
        (p.up == own.up ? same : other) += p.points;
    if (other >= params.majority * same && walls_behind(planes, own, walls) >= mostly) wrong.push_back(own.primitive);
  }
  for (const auto i : wrong) turn(planes.primitives[i].plane);
  return wrong.size();
}

std::size_t turn_walls(PlanePrimitives& planes, const CheckSides::Params& params, const Context& context) {
  const Levels levels(planes);
  const Walls all(planes);
  std::vector<std::uint8_t> wrong(planes.primitives.size(), 0);
  context.parallel_chunks(wrong.size(), 1, [&](std::size_t i, std::size_t, std::size_t) {
    const PlanePrimitive& p = planes.primitives[i];
    wrong[i] =
        !p.inliers.empty() && stands_upright(p) && has_rooms_behind(planes, i, levels, all, params.inside) ? 1 : 0;
  });
  for (std::size_t i = 0; i < wrong.size(); ++i)
    if (wrong[i] != 0) turn(planes.primitives[i].plane);
  return static_cast<std::size_t>(std::count(wrong.begin(), wrong.end(), 1));
}

}  // namespace

CheckSides::Out CheckSides::run(const In& in, const Params& params, Context& context) {
  Out out{*in.planes};
  const std::size_t levels = turn_levels(out.planes, params, context);
  const std::size_t walls = turn_walls(out.planes, params, context);
  if (levels + walls > 0)
    context.info(fmt::format("turned by what lies around them: {}, {}", counted(levels, "level plane"),
                             counted(walls, "upright plane")));
  return out;
}

}  // namespace atrium::plane
