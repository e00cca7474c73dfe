#pragma once
#include "graph/api/node.hpp"
#include "modules/types/floor_plan.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::floorplan {

enum class RoomExtent { floors, floors_and_ceilings };

/// Draws the floor plan of a structural mesh, storey by storey: walls, floors, ceilings and rooms as 2D polygons.
///
/// Any mesh whose triangles have classes will do: scene.merge's `structure`, one read back from its file, or a true
/// one. Objects are ignored. Storeys come from the mesh (none: one storey); triangles of one primitive are one face,
/// those without a primitive are one where they meet in one plane.
///
/// - Frame: the mesh's own, so a georeferenced model gives a georeferenced plan. If its up is more than
///   upright_tolerance from z, it is turned upright about the plan's origin, a whole metre near its middle, by the
///   least rotation (the plan's `to_plan`). Up is that of `transform`, if wired; else that of the floors, else of the
///   ceilings.
/// - Walls are cut at cut_height over their storey's floor, as is usual in plans; a wall that does not reach there is
///   cut at the nearest height that it has, and slanted walls stand where they are at that height. Two faces that look
///   away from each other, min_thickness to max_thickness apart, are a wall of that thickness where they overlap; a
///   face may have several opposite faces along its length. A face that has none is a wall of unknown thickness (0).
///   Ends that miss another wall by at most corner_gap are joined to it.
/// - Floors and ceilings: the union of their pieces as seen from above, holes kept. Elevation and height of a storey
///   are medians by area; without a floor, the lowest place of its walls counts as the floor. A storey without floors
///   and walls has no known elevation and height; where the ceiling is not above the floor (the model is upside down,
///   or its classes are swapped), the height is not known either, with a warning.
/// - Rooms: connected parts of the floors between the walls, up to their faces, the largest first, numbered through all
///   storeys. Ceilings count as well (room_extent), since furniture hides the floor below it; but a room is one third
///   floor at least, and `floors` stays what was seen. Gaps up to floor_gap, to walls too, are closed. Openings of up
///   to max_opening in a face (doors) divide rooms. A storey without floors has its rooms drawn from its ceilings, with
///   a warning.
///
/// A mesh without walls, floors or ceilings gives a plan without storeys, and a warning; so do storeys without walls or
/// rooms. Errors: a mesh without classes; coordinates that are not finite, or further than 10 km from the middle of the
/// mesh; triangles that name vertices that are not there; min_thickness above max_thickness.
struct Project {
  static constexpr std::string_view type = "floorplan.project";
  static constexpr std::string_view summary = "Draws floor plans from a structural mesh: walls, floors, rooms.";
  struct In {
    Input<Mesh> mesh;
    OptionalInput<Transform> transform;
  };
  struct Out {
    FloorPlan plan;
  };
  struct Params {
    double cut_height = 1.2;
    double min_thickness = 0.03;
    double max_thickness = 0.60;
    double parallel_angle = 5;
    double corner_gap = 0.30;
    double merge_distance = 0.03;
    double min_wall_length = 0.10;
    double max_opening = 1.25;
    RoomExtent room_extent = RoomExtent::floors_and_ceilings;
    double floor_gap = 0.15;
    double min_room_width = 0.40;
    double min_room_area = 1.0;
    double upright_tolerance = 1;
  };
  static constexpr auto inputs =
      std::tuple{port<&In::mesh>("Walls, floors and ceilings; triangles counter-clockwise seen from the room."),
                 port<&In::transform>("From the mesh's frame to one with z up; only its up is used.")};
  static constexpr auto outputs = std::tuple{port<&Out::plan>("One plan per storey, in the frame of the mesh.")};
  static constexpr auto params = std::tuple{
      param<&Params::cut_height>(metres, within(0, 100), "Height of the section over the storey's floor."),
      param<&Params::min_thickness>(metres, within(0.001, 5),
                                    "Least thickness of a wall: nearer faces do not belong together."),
      param<&Params::max_thickness>(metres, within(0.001, 5),
                                    "Greatest thickness of a wall: what is further apart is a room."),
      param<&Params::parallel_angle>(degrees, within(0, 45), "Faces of one wall are parallel to within this."),
      param<&Params::corner_gap>(metres, within(0, 5),
                                 "Ends of walls that miss another wall by at most this are joined to it."),
      param<&Params::merge_distance>(metres, within(0, 1),
                                     "Faces that look the same way and lie within this of each other are drawn once."),
      param<&Params::min_wall_length>(metres, within(0, 100), "Shorter pieces are left out."),
      param<&Params::max_opening>(metres, within(0, 100),
                                  "Openings of a wall's face up to this width divide rooms: doors, not wide passages."),
      param<&Params::room_extent>(
          {{"floors", RoomExtent::floors}, {"floors_and_ceilings", RoomExtent::floors_and_ceilings}},
          "What rooms are made of: the floors alone, or what floor or ceiling covers."),
      param<&Params::floor_gap>(
          metres, within(0, 5),
          "Floors that end short of a wall, or have a gap, by at most this are closed for the rooms."),
      param<&Params::min_room_width>(metres, within(0, 100),
                                     "What is narrower is no room and joins none: slivers between walls."),
      param<&Params::min_room_area>(square_metres, within(0, 1e6), "What is smaller is no room."),
      param<&Params::upright_tolerance>(degrees, within(0, 90), "A mesh whose up is within this of z is not turned."),
  };
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::floorplan
