#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace atrium::layout {

/// The plane cut into convex cells along straight lines. A line cuts the cells that it meets between two of its places,
/// each from side to side, so that it ends at other lines. Where a line passes a vertex within `tolerance`, it goes
/// through it: there are no slivers and no edges shorter than that at the cuts.
class Arrangement {
 public:
  struct Line {
    Eigen::Vector2d normal = Eigen::Vector2d::UnitX();  ///< unit length
    double offset = 0;
    double side(const Eigen::Vector2d& p) const { return normal.dot(p) + offset; }
    Eigen::Vector2d along() const { return {-normal.y(), normal.x()}; }
  };
  struct Cell {
    std::vector<std::uint32_t> corners;  ///< counter-clockwise, with the vertices that stand on a straight side
    std::vector<std::int32_t> lines;     ///< of the side from corners[i] to the next; −1: border
  };

  /// One rectangular cell.
  Arrangement(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double tolerance);

  /// Cuts along the line between the places `begin` and `end` (coordinates along line.along()).
  void cut(std::int32_t id, const Line& line, double begin, double end);

  /// Cuts one cell from side to side, if the line passes through it; says whether it did.
  bool cut_one(std::size_t cell, std::int32_t id, const Line& line);

  const std::vector<Eigen::Vector2d>& vertices() const { return vertices_; }
  const std::vector<Cell>& cells() const { return cells_; }

 private:
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) { return (std::uint64_t{a} << 32U) | b; }
  bool meets(const Cell& cell, const Line& line, double begin, double end) const;
  void split_edge(std::size_t cell, std::size_t side, const Line& line);
  void insert_corner(std::size_t cell, std::uint32_t from, std::uint32_t to, std::uint32_t vertex);
  /// Which side of a line a vertex is on: 1, −1, or 0 within the tolerance.
  int side_of(std::uint32_t vertex, const Line& line) const;
  /// The corners from first to last, closed by a side on a line.
  static Cell part(const Cell& whole, std::size_t first, std::size_t last, std::int32_t id);
  void cut_cell(std::size_t cell, std::int32_t id, const Line& line);

  std::vector<Eigen::Vector2d> vertices_;
  std::vector<Cell> cells_;
  std::unordered_map<std::uint64_t, std::size_t> owner_;  // of a directed side: the cell that runs along it
  double tolerance_;
};

}  // namespace atrium::layout
