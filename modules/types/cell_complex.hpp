#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <vector>

#include "modules/types/plane_primitives.hpp"

namespace atrium {

/// A plane that may be a floor or a ceiling.
struct CellSurface {
  static constexpr auto members() {
    return std::tuple{&CellSurface::plane, &CellSurface::primitive, &CellSurface::joined};
  }
  Plane plane;                       ///< not vertical
  std::int32_t primitive = -1;       ///< −1: inferred
  std::vector<std::int32_t> joined;  ///< smaller primitives so near to it that they are taken for it
  double height_at(const Eigen::Vector2d& p) const {
    return -(plane.normal.x() * p.x() + plane.normal.y() * p.y() + plane.offset) / plane.normal.z();
  }
};

/// A line that cells were cut along, as normal · p + offset = 0.
struct CellLine {
  static constexpr auto members() { return std::tuple{&CellLine::normal, &CellLine::offset, &CellLine::primitives}; }
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();
  double offset = 0;
  std::vector<std::int32_t> primitives;  ///< walls on it; none: slanted surfaces meet over it, or the border
};

constexpr double unknown_top = -1e9;  ///< of an edge without walls

/// A side that two cells share, or one cell and the outside of the complex.
struct CellEdge {
  static constexpr auto members() {
    return std::tuple{&CellEdge::from,       &CellEdge::to,        &CellEdge::left,       &CellEdge::right,
                      &CellEdge::line,       &CellEdge::wall_left, &CellEdge::wall_right, &CellEdge::face_left,
                      &CellEdge::face_right, &CellEdge::top_left,  &CellEdge::top_right};
  }
  std::uint32_t from = 0, to = 0;  ///< vertices
  std::int32_t left = -1;          ///< the cell left of from → to
  std::int32_t right = -1;
  std::int32_t line = -1;
  double wall_left = 0;            ///< share of its length on which a wall that looks to the left reaches the ceiling
  double wall_right = 0;           ///< the same for walls that look to the right
  double face_left = 0;            ///< share of its length on which any tall face was seen that looks to the left
  double face_right = 0;           ///< the same for faces that look to the right
  double top_left = unknown_top;   ///< where most of the walls end that look to the left, metres
  double top_right = unknown_top;  ///< the same for walls that look to the right
};

/// How much of a cell a surface covers.
struct CellCover {
  static constexpr auto members() { return std::tuple{&CellCover::surface, &CellCover::share}; }
  std::int32_t surface = -1;  ///< index into floors or ceilings
  double share = 0;
};

/// A convex polygon seen from above.
struct LayoutCell {
  static constexpr auto members() {
    return std::tuple{&LayoutCell::corners,       &LayoutCell::edges,     &LayoutCell::area,
                      &LayoutCell::floors,        &LayoutCell::ceilings,  &LayoutCell::floor_cover,
                      &LayoutCell::ceiling_cover, &LayoutCell::any_cover, &LayoutCell::enclosed,
                      &LayoutCell::measured,      &LayoutCell::room,      &LayoutCell::floor,
                      &LayoutCell::ceiling};
  }
  std::vector<std::uint32_t> corners;  ///< counter-clockwise; some may stand on a straight side
  std::vector<std::uint32_t> edges;    ///< edges[i] joins corners[i] and the next
  double area = 0;                     ///< square metres
  std::vector<CellCover> floors, ceilings;
  double floor_cover = 0;    ///< share of its area over which any floor was seen
  double ceiling_cover = 0;  ///< share of its area under which any ceiling was seen
  double any_cover = 0;      ///< share of its area with points between floor and ceiling
  double enclosed = 0;    ///< share of directions, level and from its middle, in which the first wall looks towards it
  bool measured = false;  ///< false: the noise of the walls around it fills it, so that nothing is known of it
  // Written by the nodes that decide:
  std::int32_t room = -1;  ///< −1: outside, or in a wall
  std::int32_t floor = -1, ceiling = -1;
};

/// The space of one storey, cut into upright prisms.
struct StoreyCells {
  static constexpr auto members() {
    return std::tuple{
        &StoreyCells::low,      &StoreyCells::high,     &StoreyCells::floor_height, &StoreyCells::ceiling_height,
        &StoreyCells::wall_end, &StoreyCells::vertices, &StoreyCells::lines,        &StoreyCells::edges,
        &StoreyCells::cells,    &StoreyCells::floors,   &StoreyCells::ceilings};
  }
  double low = 0, high = 0;                     ///< the storey's part of the z axis, metres
  double floor_height = 0, ceiling_height = 0;  ///< of the largest floor and ceiling, or of the walls' ends
  double wall_end = unknown_top;                ///< below which two fifths of the walls end, if no ceiling was scanned
  std::vector<Eigen::Vector2d> vertices;
  std::vector<CellLine> lines;
  std::vector<CellEdge> edges;
  std::vector<LayoutCell> cells;
  std::vector<CellSurface> floors, ceilings;
};

/// A building's space cut into cells along the planes of its walls, storey by storey: what is between floor and
/// ceiling of a cell is inside or outside as a whole. Metres, z up; a place is origin + coordinate.
struct CellComplex {
  static constexpr std::string_view port_type = "CellComplex";
  static constexpr auto members() {
    return std::tuple{&CellComplex::origin, &CellComplex::pixel, &CellComplex::noise, &CellComplex::storeys};
  }
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  double pixel = 0;                  ///< edge of the squares in which coverage was measured, metres
  double noise = 0;                  ///< mean distance of points from their planes, metres
  std::vector<StoreyCells> storeys;  ///< lowest first
};

}  // namespace atrium
