#include "modules/plane/plane_cells.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "graph/api/random.hpp"

namespace atrium::plane {

PlaneCells::PlaneCells(const Eigen::Vector3d& normal, double reach) : table_(1024, absent) {
  // All points of a cell are within reach of each other.
  const double edge = reach / std::sqrt(2.0);
  const Eigen::Vector3d u = normal.unitOrthogonal();
  u_ = (u / edge).cast<float>();
  v_ = (normal.cross(u) / edge).cast<float>();
}

Eigen::Vector2f PlaneCells::position(const Eigen::Vector3f& p) const {
  constexpr float limit = 1e9F;  // cells further off than this share one
  return {std::clamp(u_.dot(p), -limit, limit), std::clamp(v_.dot(p), -limit, limit)};
}

PlaneCells::Key PlaneCells::key(const Eigen::Vector2f& at) {
  return pack(static_cast<std::int32_t>(std::floor(at.x())), static_cast<std::int32_t>(std::floor(at.y())));
}

std::uint32_t PlaneCells::add(const Eigen::Vector3f& p) {
  const Eigen::Vector2f at = position(p);
  const std::uint32_t cell = insert(key(at));
  if (cell == first_.size()) {
    first_.push_back(absent);
    filled_.push_back(0);
  }
  const auto part = [](float t) { return std::min(static_cast<unsigned>((t - std::floor(t)) * 8), 7U); };
  const std::uint64_t bit = 1ULL << (part(at.x()) * 8 + part(at.y()));
  if ((filled_[cell] & bit) == 0) {
    filled_[cell] |= bit;
    samples_.push_back({at, first_[cell]});
    first_[cell] = static_cast<std::uint32_t>(samples_.size() - 1);
  }
  return cell;
}

bool PlaneCells::linked(std::uint32_t a, std::uint32_t b) const {
  constexpr float reach_squared = 2;  // in cells
  for (std::uint32_t i = first_[a]; i != absent; i = samples_[i].next)
    for (std::uint32_t j = first_[b]; j != absent; j = samples_[j].next)
      if ((samples_[i].at - samples_[j].at).squaredNorm() <= reach_squared) return true;
  return false;
}

std::size_t PlaneCells::slot(Key key) const {
  const std::size_t mask = table_.size() - 1;
  std::size_t s = mix_seed(key, 0) & mask;
  while (table_[s] != absent && keys_[table_[s]] != key) s = (s + 1) & mask;
  return s;
}

std::uint32_t PlaneCells::find(Key key) const { return table_.empty() ? absent : table_[slot(key)]; }

std::uint32_t PlaneCells::insert(Key key) {
  // Points come along a space-filling curve: most are in the cell of the point before.
  if (last_ != absent && last_key_ == key) return last_;
  std::size_t s = slot(key);
  if (table_[s] == absent) {
    if (2 * keys_.size() >= table_.size()) {
      grow();
      s = slot(key);
    }
    table_[s] = static_cast<std::uint32_t>(keys_.size());
    keys_.push_back(key);
  }
  last_key_ = key;
  return last_ = table_[s];
}

void PlaneCells::grow() {
  table_.assign(4 * table_.size(), absent);
  for (std::uint32_t i = 0; i < keys_.size(); ++i) table_[slot(keys_[i])] = i;
}

std::vector<std::uint32_t> PlaneCells::components() const {
  std::vector<std::uint32_t> parent(keys_.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  // Half of the cells that are within reach, the nearest first: most of the others are connected through them then.
  constexpr std::array<std::array<std::int32_t, 2>, 10> steps{
      {{1, 0}, {0, 1}, {1, 1}, {1, -1}, {2, 0}, {0, 2}, {2, 1}, {1, 2}, {2, -1}, {1, -2}}};
  for (const auto& [du, dv] : steps)
    for (std::uint32_t i = 0; i < keys_.size(); ++i) {
      const std::uint32_t other = find(neighbour(keys_[i], du, dv));
      if (other == absent) continue;
      const std::uint32_t a = root(i);
      const std::uint32_t b = root(other);
      if (a != b && linked(i, other)) parent[std::max(a, b)] = std::min(a, b);
    }
  for (std::uint32_t i = 0; i < keys_.size(); ++i) parent[i] = root(i);
  return parent;
}

PlaneCells PlaneCells::dilated(const std::vector<bool>& chosen) const {
  PlaneCells result;
  result.u_ = u_;
  result.v_ = v_;
  result.table_.assign(1024, absent);
  for (std::uint32_t i = 0; i < keys_.size(); ++i) {
    if (!chosen[i]) continue;
    for (std::int32_t du = -1; du <= 1; ++du)
      for (std::int32_t dv = -1; dv <= 1; ++dv) result.insert(neighbour(keys_[i], du, dv));
  }
  return result;
}

}  // namespace atrium::plane
