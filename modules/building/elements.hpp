#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "modules/types/building.hpp"
#include "modules/types/floor_plan.hpp"

/// What a building is built of: walls, slabs and columns as solids that neither overlap nor leave gaps, made from the
/// faces of its rooms. All in the building's frame (metres, z up), relative to its origin.
namespace atrium::building {

/// A wall's foot and head between two places along it; both straight.
struct ProfilePart {
  double from = 0, to = 0;            ///< along the wall
  double low_from = 0, low_to = 0;    ///< height of its foot at these two places
  double high_from = 0, high_to = 0;  ///< height of its head there
  bool level() const;                 ///< neither foot nor head slopes
};

/// A rectangle taken out of a wall: all of one of the building's openings, or what of it lies in this wall.
struct WallHole {
  std::int32_t opening = -1;  ///< of Building::openings
  double from = 0, to = 0;    ///< along the wall
  double low = 0, high = 0;   ///< heights
  bool main = true;           ///< this wall holds the greatest part of the opening
  double area = 0;            ///< of the rectangle within the wall's side, square metres
  double volume = 0;          ///< that it takes from the wall, cubic metres
};

/// A stretch of wall between junctions. Along it runs s from `start`, across it t to its left; `start` is on the middle
/// line.
struct Wall {
  std::int32_t storey = 0;
  std::vector<std::int32_t> faces;  ///< that it was made from: the one seen from its left, then the right one
  std::int32_t left_room = -1, right_room = -1;
  Eigen::Vector2d start = Eigen::Vector2d::Zero();
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();
  double length = 0;  ///< of the footprint along the wall
  double thickness = 0;
  bool assumed = false;              ///< one face only is known, and no thickness was given: it is the parameter
  PlanPolygon footprint;             ///< may have holes only where a column or a room stands in it
  std::vector<ProfilePart> profile;  ///< from 0 to length, without gaps
  std::vector<WallHole> holes;

  Eigen::Vector2d local(const Eigen::Vector2d& p) const;   ///< (s, t)
  Eigen::Vector2d global(const Eigen::Vector2d& p) const;  ///< of (s, t)
  double low() const;                                      ///< least height
  double high() const;                                     ///< greatest height
  bool level() const { return profile.size() == 1 && profile.front().level(); }
  /// Of its side, without (gross) or less the openings (net); square metres.
  double gross_area() const;
  double net_area() const;
  /// Of the solid without (gross) or less the openings (net); cubic metres.
  double gross_volume() const;
  double net_volume() const;
};

/// A part of a wall's footprint between two of its profile's stops.
std::vector<PlanPolygon> footprint_part(const Wall& wall, const ProfilePart& part);

enum class SlabKind { floor, ceiling, between, roof };

/// A plate between two parallel planes with upright sides: `footprint` seen from above, `thickness` measured upright.
struct Slab {
  SlabKind kind = SlabKind::floor;
  std::int32_t storey = 0;
  std::vector<std::int32_t> faces;  ///< floors and ceilings that it was made from
  PlanPolygon footprint;
  Eigen::Vector3d bottom = Eigen::Vector3d::Zero();  ///< the lower plane z = bottom · (x, y, 1)
  double thickness = 0;
  bool assumed = false;                ///< one face only was seen
  bool whole = false;                  ///< all of its faces' area is in it
  std::vector<std::int32_t> openings;  ///< of Building::openings, that go through it

  bool level() const { return bottom.x() == 0 && bottom.y() == 0; }
  double bottom_at(const Eigen::Vector2d& p) const { return bottom.x() * p.x() + bottom.y() * p.y() + bottom.z(); }
};

/// A hole in a room's plan that is no wider than a column.
struct Column {
  std::int32_t storey = 0, room = -1;
  std::vector<std::int32_t> faces;
  PlanRing outline;  ///< counter-clockwise
  double low = 0, high = 0;
};

/// Where a wall or column stands behind a face: between `from` and `to` along it, as seen from its room from the right
/// to the left.
struct Backing {
  std::int32_t wall = -1;    ///< of Elements::walls, or −1
  std::int32_t column = -1;  ///< of Elements::columns, or −1
  double from = 0, to = 0;   ///< along `along` from the plan's origin
};

/// The line of a wall's face in the plan.
struct FaceLine {
  std::int32_t face = -1;
  Eigen::Vector2d normal = Eigen::Vector2d::UnitY();  ///< into the room
  double offset = 0;                                  ///< normal · p of its points
  double low = 0, high = 0;                           ///< heights of its corners
  std::vector<Backing> backing;

  Eigen::Vector2d along() const { return {normal.y(), -normal.x()}; }
  Eigen::Vector2d at(double s) const { return normal * offset + along() * s; }
};

struct Elements {
  std::vector<Wall> walls;
  std::vector<Slab> slabs;
  std::vector<Column> columns;
  std::vector<FaceLine> lines;             ///< of all faces of walls, but for steps within a room
  std::vector<std::int32_t> slab_of_face;  ///< per face of the building; −1: none
};

struct ElementLimits {
  double max_thickness = 0.60;  ///< of walls between two faces, metres
  double max_slab = 0.80;       ///< of slabs between two storeys, metres
  double assumed_wall = 0.20;   ///< thickness where one face only is known
  double assumed_slab = 0.20;
  double max_column_width = 1.0;
};

/// Makes the elements of a building whose z is up and that check() finds sound.
///
/// 1. Faces of walls are cut with the plan of their storey. Two that look away from each other at most max_thickness
///    apart are a wall where they overlap; the rest of a face has the thickness behind it that was given by hand
///    (BuildingFace::backing), or the assumed one. Steps within a room are no walls; holes in a room's plan at most
///    max_column_width wide are columns.
/// 2. Ends are extended to the far face of the wall that they meet. Where walls overlap then, at corners and junctions,
///    the higher one has the place, then one of which both faces were seen or whose thickness was given, then the
///    longer one: the others end there. What lies in a room is taken away. A wall that is cut in two that way is two
///    walls.
/// 3. Foot and head follow the faces' outlines: of two the lower foot, the higher head. Where a wall of an upper storey
///    stands on it, it ends below that.
/// 4. Floors at one height, and ceilings in one plane, are one slab where they hang together; walls that stand on it,
///    or end at it, belong to its area. A ceiling and the floor of the storey above, at most max_slab apart, are one
///    slab where they overlap.
Elements elements_of(const Building& building, const ElementLimits& limits);

}  // namespace atrium::building
