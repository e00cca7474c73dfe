#include "modules/layout/doorways.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "modules/layout/enclosure.hpp"

namespace atrium::layout {
namespace {

constexpr double door = 0.55, widest = 1.35;  // metres: what is narrower is no passage, whatever is over it
constexpr double least_flank = 0.15;          // metres
constexpr double highest_lintel = 2.3;        // metres over the floor

/// A piece of a wall's line, as its side looks.
struct Piece {
  double begin, end;
  double CellEdge::*wall;
  double CellEdge::*face;
  double CellEdge::*top;
  std::uint32_t edge;
};

/// The pieces of each line, from end to end; [0] those of the side that the line's normal points to.
std::vector<std::array<std::vector<Piece>, 2>> pieces_of(const StoreyCells& storey) {
  std::vector<std::array<std::vector<Piece>, 2>> result(storey.lines.size());
  for (std::uint32_t e = 0; e < storey.edges.size(); ++e) {
    const CellEdge& edge = storey.edges[e];
    if (edge.line < 0) continue;
    const auto l = static_cast<std::size_t>(edge.line);
    const Eigen::Vector2d &a = storey.vertices[edge.from], &b = storey.vertices[edge.to];
    const Eigen::Vector2d along(-storey.lines[l].normal.y(), storey.lines[l].normal.x());
    const Eigen::Vector2d left(a.y() - b.y(), b.x() - a.x());
    const auto [begin, end] = std::minmax({along.dot(a), along.dot(b)});
    const std::size_t side = storey.lines[l].normal.dot(left) > 0 ? 0 : 1;
    result[l][side].push_back({begin, end, &CellEdge::wall_left, &CellEdge::face_left, &CellEdge::top_left, e});
    result[l][1 - side].push_back({begin, end, &CellEdge::wall_right, &CellEdge::face_right, &CellEdge::top_right, e});
  }
  for (auto& sides : result)
    for (auto& pieces : sides)
      std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) {
        return a.begin != b.begin ? a.begin < b.begin : a.edge < b.edge;
      });
  return result;
}

/// Walks along one side of a line and closes its gaps.
class Closing {
 public:
  Closing(StoreyCells& storey, const std::vector<Piece>& pieces) : storey_(storey), pieces_(pieces) {}

  void run() {
    std::size_t flank = 0;  // the first piece of the wall before the gap
    for (std::size_t i = 0; i < pieces_.size();) {
      if (!stands(i)) {
        flank = ++i;
        continue;
      }
      std::size_t gap = i;
      while (gap < pieces_.size() && stands(gap)) ++gap;
      std::size_t next = gap;
      while (next < pieces_.size() && !stands(next)) ++next;
      std::size_t end = next;
      while (end < pieces_.size() && stands(end)) ++end;
      if (next < pieces_.size() && next > gap) close(flank, gap, next, end);
      flank = i = next;
    }
  }

 private:
  const CellEdge& edge(std::size_t i) const { return storey_.edges[pieces_[i].edge]; }
  bool stands(std::size_t i) const {
    constexpr double mostly = 0.5;
    const Piece& p = pieces_[i];
    return edge(i).*p.face >= mostly && edge(i).*p.top >= least_wall_top(storey_);
  }

  /// Pieces [flank, gap) and [next, end) are wall, those between are not.
  void close(std::size_t flank, std::size_t gap, std::size_t next, std::size_t end) {
    const double begin = pieces_[gap].begin, width = pieces_[next].begin - begin;
    if (width > widest) return;
    if (begin - pieces_[flank].begin < least_flank || pieces_[end - 1].end - pieces_[next].begin < least_flank) return;
    const double top = std::max(edge(gap - 1).*pieces_[gap - 1].top, edge(next).*pieces_[next].top);
    if (width >= door && top > storey_.floor_height + highest_lintel) return;
    for (std::size_t i = gap; i < next; ++i) {
      CellEdge& e = storey_.edges[pieces_[i].edge];
      e.*pieces_[i].wall = e.*pieces_[i].face = 1;
      e.*pieces_[i].top = top;
    }
  }

  StoreyCells& storey_;
  const std::vector<Piece>& pieces_;
};

}  // namespace

void close_doorways(StoreyCells& storey) {
  for (const auto& sides : pieces_of(storey))
    for (const auto& pieces : sides) Closing(storey, pieces).run();
}

}  // namespace atrium::layout
