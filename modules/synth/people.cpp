#include "modules/synth/people.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace atrium::synth {
namespace {

using V = Eigen::Vector3d;
constexpr double nobody = std::numeric_limits<double>::infinity();

// The nearer meeting with an ellipsoid of equal level half axes.
double meet(const V& from, const V& direction, const V& centre, double wide, double high) {
  const V scale(1 / wide, 1 / wide, 1 / high);
  const V p = (from - centre).cwiseProduct(scale), d = direction.cwiseProduct(scale);
  const double a = d.squaredNorm(), b = p.dot(d), c = p.squaredNorm() - 1, root = b * b - a * c;
  if (root < 0 || c < 0) return nobody;
  const double t = (-b - std::sqrt(root)) / a;
  return t > 0 ? t : nobody;
}

}  // namespace

People::People(std::size_t count, const std::vector<Station>& stations, std::size_t block, double eye,
               const TriangleTree& walls, Random random)
    : block_(block) {
  constexpr double nearest = 1.0, farthest = 5.0, wall = 0.4;
  for (std::size_t first = 0; count > 0 && first < stations.size(); first += block) {
    auto& people = blocks_.emplace_back();
    const V& eyes = stations[first].place;
    const auto somewhere = [&](V& feet) {
      for (int attempt = 0; attempt < 50; ++attempt) {
        const double angle = random.uniform(0, 2 * std::numbers::pi);
        const V direction(std::cos(angle), std::sin(angle), 0);
        const auto hit = walls.cast(eyes, direction, farthest + wall);
        const double free = hit ? hit.distance - wall : farthest;
        if (free < nearest) continue;
        feet = eyes + direction * random.uniform(nearest, free) - V(0, 0, eye);
        return true;
      }
      return false;
    };
    for (std::size_t i = 0; i < count; ++i) {
      Person person;
      const bool there = random.uniform() < 0.5;
      if (somewhere(person.start) && somewhere(person.end) && there) people.push_back(person);
    }
  }
}

double People::cast(const V& from, const V& direction, std::size_t station, double share) const {
  if (blocks_.empty()) return nobody;
  const double time = (static_cast<double>(station % block_) + share) / static_cast<double>(block_);
  double nearest = nobody;
  for (const auto& person : blocks_[station / block_]) {
    const V feet = person.start + time * (person.end - person.start);
    nearest = std::min({nearest, meet(from, direction, feet + V(0, 0, 0.8), 0.22, 0.8),
                        meet(from, direction, feet + V(0, 0, 1.66), 0.11, 0.13)});
  }
  return nearest;
}

}  // namespace atrium::synth
