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

/// The edges at each vertex.
using Meeting = std::vector<std::vector<std::uint32_t>>;

Meeting meeting_edges(const StoreyCells& storey) {
  Meeting result(storey.vertices.size());
  for (std::uint32_t e = 0; e < storey.edges.size(); ++e)
    for (const auto v : {storey.edges[e].from, storey.edges[e].to}) result[v].push_back(e);
  return result;
}

/// Walks along one side of a line and closes its gaps.
class Closing {
 public:
  Closing(StoreyCells& storey, const Meeting& meeting, const std::vector<Piece>& pieces)
      : storey_(storey), meeting_(meeting), pieces_(pieces) {}

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
    if (has_wall_across(gap) && has_wall_across(next)) return;
    const double top = std::max(edge(gap - 1).*pieces_[gap - 1].top, edge(next).*pieces_[next].top);
    if (width >= door && top > storey_.floor_height + highest_lintel) return;
    for (std::size_t i = gap; i < next; ++i) {
      CellEdge& e = storey_.edges[pieces_[i].edge];
      e.*pieces_[i].wall = e.*pieces_[i].face = 1;
      e.*pieces_[i].top = top;
    }
  }

  /// Whether a wall runs away from where a piece begins: at both ends of a gap these are the walls of a corridor that
  /// passes between two walls.
  bool has_wall_across(std::size_t piece) const {
    const CellEdge& e = edge(piece);
    const std::int32_t line = e.line;
    const Eigen::Vector2d& normal = storey_.lines[static_cast<std::size_t>(line)].normal;
    const Eigen::Vector2d along(-normal.y(), normal.x());
    const auto end = along.dot(storey_.vertices[e.from]) < along.dot(storey_.vertices[e.to]) ? e.from : e.to;
    constexpr double across = 0.5, long_enough = 0.6;  // cosine of 60 degrees; metres: more than a jamb
    for (const auto first : meeting_[end]) {
      const std::int32_t other = storey_.edges[first].line;
      if (other < 0 || other == line ||
          std::abs(storey_.lines[static_cast<std::size_t>(other)].normal.dot(normal)) > across)
        continue;
      if (standing_length(end, first) >= long_enough) return true;
    }
    return false;
  }

  /// How far a wall goes on along one line from a vertex, from its first edge on.
  double standing_length(std::uint32_t vertex, std::uint32_t first) const {
    constexpr double enough = 1;  // metres
    double length = 0;
    for (std::int64_t at = first; at >= 0 && length < enough;) {
      const CellEdge& e = storey_.edges[static_cast<std::size_t>(at)];
      if (std::max(e.face_left, e.face_right) < 0.5) break;
      length += (storey_.vertices[e.to] - storey_.vertices[e.from]).norm();
      vertex = e.from == vertex ? e.to : e.from;
      const auto& around = meeting_[vertex];
      const auto next = std::find_if(around.begin(), around.end(), [&](std::uint32_t k) {
        return k != static_cast<std::uint32_t>(at) && storey_.edges[k].line == e.line;
      });
      at = next == around.end() ? -1 : static_cast<std::int64_t>(*next);
    }
    return length;
  }

  StoreyCells& storey_;
  const Meeting& meeting_;
  const std::vector<Piece>& pieces_;
};

}  // namespace

void close_doorways(StoreyCells& storey) {
  const Meeting meeting = meeting_edges(storey);
  for (const auto& sides : pieces_of(storey))
    for (const auto& pieces : sides) Closing(storey, meeting, pieces).run();
}

}  // namespace atrium::layout
