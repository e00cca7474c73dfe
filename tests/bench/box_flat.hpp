#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "graph/api/random.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::bench {

/// A flat of four rooms (10 m × 8 m × 2.6 m, 12 cm walls between them, each seen from both sides) with tables in it:
/// 315 m² of surface, evenly and randomly sampled with Gaussian noise along the normals. `normals` are the true ones,
/// into the room; sensors stand in the middle of each room.
inline Cloud box_flat(std::size_t count, double noise = 0.008, std::uint64_t seed = 1) {
  struct Patch {
    Eigen::Vector3d corner, a, b, normal;
    std::uint16_t room;
  };
  std::vector<Patch> patches;
  Cloud cloud;
  const auto box = [&](const Eigen::Vector3d& low, const Eigen::Vector3d& high, double side, std::uint16_t room) {
    const Eigen::Vector3d size = high - low;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d n = Eigen::Vector3d::Unit(axis),
                            a = Eigen::Vector3d::Unit((axis + 1) % 3) * size[(axis + 1) % 3],
                            b = Eigen::Vector3d::Unit((axis + 2) % 3) * size[(axis + 2) % 3];
      patches.push_back({low, a, b, side * n, room});
      patches.push_back({low + n * size[axis], a, b, -side * n, room});
    }
  };
  for (int i = 0; i < 4; ++i) {
    const double x = i % 2 * 5.12, y = i / 2 * 4.12;
    const auto room = static_cast<std::uint16_t>(i);
    box({x, y, 0}, {x + 5, y + 4, 2.6}, 1, room);
    box({x + 1, y + 1, 0.7}, {x + 2.4, y + 1.8, 0.74}, -1, room);
    box({x + 4, y + 2, 0.3}, {x + 4.5, y + 3.5, 2.0}, -1, room);
    cloud.sensors.emplace_back(static_cast<float>(x + 2.5), static_cast<float>(y + 2), 1.5F);
  }
  std::vector<double> areas;
  double total = 0;
  for (const auto& p : patches) areas.push_back(total += p.a.norm() * p.b.norm());
  Random random(seed);
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = std::upper_bound(areas.begin(), areas.end() - 1, random.uniform(0, total)) - areas.begin();
    const Patch& p = patches[static_cast<std::size_t>(at)];
    const double u = random.uniform(), v = random.uniform();
    cloud.points.push_back((p.corner + u * p.a + v * p.b + noise * random.normal() * p.normal).cast<float>());
    cloud.normals.push_back(p.normal.cast<float>());
    cloud.source.push_back(p.room);
  }
  return cloud;
}

}  // namespace atrium::bench
