#include "modules/layout/inferred_ceilings.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace atrium::layout {
namespace {

struct CeilingRoom {
  double area = 0, seen = 0;
  std::vector<std::pair<double, double>> tops;  // of its walls, with their lengths
};

/// The height above which a third of the length ends.
double upper_third(std::vector<std::pair<double, double>>& tops) {
  std::sort(tops.begin(), tops.end());
  double length = 0;
  for (const auto& top : tops) length += top.second;
  double left = length / 3;
  for (auto top = tops.rbegin(); top != tops.rend(); ++top)
    if ((left -= top->second) <= 0) return top->first;
  return tops.front().first;
}

}  // namespace

std::map<std::int32_t, std::int32_t> infer_ceilings(StoreyCells& storey, double min_seen) {
  std::map<std::int32_t, CeilingRoom> rooms;
  const auto room_of = [&](std::int32_t cell) {
    return cell < 0 ? -1 : storey.cells[static_cast<std::size_t>(cell)].room;
  };
  for (const auto& cell : storey.cells) {
    if (cell.room < 0) continue;
    rooms[cell.room].area += cell.area;
    rooms[cell.room].seen += cell.area * cell.ceiling_cover;
  }
  for (const auto& edge : storey.edges) {
    const std::int32_t left = room_of(edge.left), right = room_of(edge.right);
    if (left == right) continue;
    const double length = (storey.vertices[edge.to] - storey.vertices[edge.from]).norm();
    if (left >= 0 && edge.top_left != unknown_top) rooms[left].tops.emplace_back(edge.top_left, length);
    if (right >= 0 && edge.top_right != unknown_top) rooms[right].tops.emplace_back(edge.top_right, length);
  }
  std::map<std::int32_t, std::int32_t> result;
  for (auto& [index, room] : rooms) {
    if (room.seen >= min_seen * room.area || room.tops.empty()) continue;
    result[index] = static_cast<std::int32_t>(storey.ceilings.size());
    storey.ceilings.push_back({{{0, 0, -1}, upper_third(room.tops)}, -1, {}});
  }
  return result;
}

}  // namespace atrium::layout
