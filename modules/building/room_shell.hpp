#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "modules/geometry/plane_frame.hpp"
#include "modules/types/building.hpp"
#include "modules/types/floor_plan.hpp"

/// Closed surfaces of rooms put together from plane polygons.
namespace atrium::building {

/// A plane polygon of a room's surface, with places of its own: of one of the building's faces, or new.
struct ShellPiece {
  BuildingFace face;         ///< plane, class and what was seen of it; its rings are not used
  std::int32_t source = -1;  ///< the face that it is a part of; −1: it is new
  std::vector<Eigen::Vector3d> outline;
  std::vector<std::vector<Eigen::Vector3d>> holes;
};

/// A room's surface; rings are indices into `vertices`.
struct RoomShell {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<BuildingFace> faces;
  std::vector<std::vector<std::int32_t>> sources;  ///< per face: the faces that it was made from
};

/// The room's faces as pieces, and one face as a piece.
std::vector<ShellPiece> pieces_of(const Building& building, const BuildingRoom& room);
ShellPiece piece_of(const Building& building, std::int32_t face);
/// A polygon that nobody has seen: a floor, a ceiling or a wall by its normal, which points into the room.
ShellPiece new_piece(std::vector<Eigen::Vector3d> outline, const Eigen::Vector3d& normal);
/// A part of a face's polygon as a piece of it.
ShellPiece part_of(const ShellPiece& whole, const PlaneFrame& frame, const PlanPolygon& polygon);
/// The frame of flat_polygon().
PlaneFrame frame_of(const Building& building, const BuildingFace& face);

/// Joins pieces that meet along their edges: places at most half a millimetre apart are one, pieces of one class that
/// lie in one plane to within a millimetre and have the same `backing` are one face, and corners that are none in any
/// face go. Pieces without area are left out. `observed` of a joined face is the mean of its pieces by area, `residual`
/// the RMS of those that were seen; the plane and the primitive are those of its largest piece.
RoomShell joined_shell(const std::vector<ShellPiece>& pieces);

/// The border that the pieces leave open, as rings that close it: counter-clockwise seen from where `normal` points to,
/// holes clockwise. Empty for a closed surface.
struct OpenBorder {
  std::vector<std::vector<Eigen::Vector3d>> outlines, holes;
};
OpenBorder open_border(const std::vector<ShellPiece>& pieces, const Eigen::Vector3d& normal);

/// Each side of a face is a side of another one that runs the other way.
bool is_closed(const std::vector<BuildingFace>& faces);
/// Into how many parts the faces fall that hang together over their sides.
std::size_t parts_of(const std::vector<BuildingFace>& faces);

/// A face's polygon in the plane frame whose x is level and whose y is as steep as the plane allows.
PlanPolygon flat_polygon(const Building& building, const BuildingFace& face);

}  // namespace atrium::building
