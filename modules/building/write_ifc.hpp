#pragma once
#include "graph/api/node.hpp"
#include "modules/types/building.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/mesh.hpp"

namespace atrium::building {

/// Writes a building as IFC4 (ISO 16739-1:2018, in the clear text of ISO 10303-21), for BIM programs.
///
/// What is in it: IfcProject, IfcSite, IfcBuilding, an IfcBuildingStorey per storey, an IfcSpace per room, IfcWall,
/// IfcSlab (floors, ceilings, and sloped ceilings as roofs), IfcColumn, an IfcOpeningElement per opening with the
/// IfcDoor or IfcWindow that fills it, IfcRelSpaceBoundary (first level) with their polygons, IfcMaterial by class, and
/// with `furniture` an IfcBuildingElementProxy per connected part of that mesh.
///
/// How walls are formed:
/// - The faces of walls are cut with each storey's plan at 1.2 m. Two faces that look away from each other at most
///   max_thickness apart are a wall where they overlap. The rest of a face is a wall of the thickness that was given
///   for it by hand (`backing` of the face), or else of assumed_thickness behind it (property ThicknessAssumed, and
///   another colour).
/// - A wall ends where what is behind one of its faces changes, so a wall is a stretch between junctions. Its ends are
///   extended to the far face of the wall that they meet. Where walls overlap then, the higher one has the place, then
///   one of which both faces were seen or whose thickness was given, then the longer one; the others end at it, so
///   corners and junctions have neither gap nor overlap. What lies in a room is taken away; what is left of a wall with
///   less than 0.02 m² joins a neighbour.
/// - Foot and head follow the outlines of the faces: of two the lower foot and the higher head. Where a wall of the
///   storey above stands in the upper part of a wall (beside a hall of two storeys), that one ends below it.
/// - Steps within a room are no walls. Holes in a room's plan up to max_column_width wide both ways are columns.
///
/// Slabs: floors at one height, and ceilings in one plane, are one slab where they hang together, together with the
/// walls that stand on it or end at it. A ceiling and the floor over it at most max_slab_thickness apart are one slab.
/// Others have assumed_slab_thickness, measured across the slab. Slabs under sloped ceilings have upright sides.
///
/// Solids are extruded wherever that is exact; walls of sloped heads with other than square ends, and rooms that are no
/// prisms, are polygon meshes. Openings are boxes that reach 1 cm out of the wall on both sides. A door or window that
/// no wall was found for stands by itself, with a warning.
///
/// Quantities: Qto_SpaceBaseQuantities, Qto_WallBaseQuantities, Qto_SlabBaseQuantities, Qto_ColumnBaseQuantities,
/// Qto_DoorBaseQuantities, Qto_WindowBaseQuantities. Properties: Atrium_Evidence with Coverage (share of the faces'
/// area that points cover), Residual (their RMS distance, metres), FacesSeen, FacesInferred, Inferred (no face seen),
/// Faces (their numbers in building.json), RoomConfidence, of rooms Doubts, and of what was corrected by hand
/// Corrections (its faces' and openings' texts); IsExternal where rooms are on both sides.
///
/// GlobalIds are hashes of what the element is (its kind, its faces) and of the building's corners: equal buildings
/// have equal ids, whatever the thicknesses assumed. With `id_space` they are hashes of that text instead of the
/// corners, so that a corrected building keeps them.
///
/// Metres, z up. Without a coordinate reference system places are those of the scan; further than 1 km from zero, the
/// site's placement holds a shift by whole metres. With one (`crs`, or that of `scan`) IfcMapConversion holds it, and
/// the site none. A scan in another unit than metres names no such system, since it counts in its own; a building that
/// is turned by more than 10 degrees to be upright is in none, with a warning. Text is written as ASCII, other
/// characters as \X2\. The time in the header is always the same.
///
/// The text is read back before the file appears: every reference, the number of fields of each type, and that no
/// GlobalId is there twice. A building without rooms gives a file without storeys' contents, and a warning. Errors:
/// numbers that are not finite, indices of what is not there; a name that is no coordinate reference system; a folder
/// that cannot be written. Then no file is there. Cost: O(walls²) for the search of neighbours.
struct WriteIfc {
  static constexpr std::string_view type = "building.write_ifc";
  static constexpr std::string_view summary = "Writes a building as IFC4: spaces, walls, slabs, doors, windows.";
  struct In {
    Input<Building> building;
    OptionalInput<Transform> transform;
    OptionalInput<Cloud> scan;
    OptionalInput<Mesh> furniture;
  };
  struct Params {
    OutputPath path{"building.ifc"};
    std::string project = "Atrium";
    std::string crs;
    std::string id_space;
    double assumed_thickness = 0.20;
    double assumed_slab_thickness = 0.20;
    double max_thickness = 0.60;
    double max_slab_thickness = 0.80;
    double max_column_width = 1.0;
    bool boundaries = true;
  };
  static constexpr auto inputs =
      std::tuple{port<&In::building>("What is written."),
                 port<&In::transform>("From the frame that is wanted to that of the building."),
                 port<&In::scan>("The scan that it was made from: its coordinate reference system."),
                 port<&In::furniture>("A mesh in the frame that is wanted; its parts become proxies.")};
  static constexpr auto params = std::tuple{
      param<&Params::path>("The file, in the run's folder."),
      param<&Params::project>("The project's name."),
      param<&Params::crs>("Coordinate reference system of the input: EPSG:25832; empty: that of `scan`, or local."),
      param<&Params::id_space>("What GlobalIds are derived from; empty: the building's corners."),
      param<&Params::assumed_thickness>(metres, within(0.01, 2), "Thickness of walls of which one face only is known."),
      param<&Params::assumed_slab_thickness>(
          metres, within(0.01, 2), "Thickness of floors, ceilings and roofs of which one face only is known."),
      param<&Params::max_thickness>(metres, within(0.01, 5), "Greatest thickness of a wall between two faces."),
      param<&Params::max_slab_thickness>(metres, within(0.02, 5),
                                         "Greatest thickness of a slab between a ceiling and the floor over it."),
      param<&Params::max_column_width>(metres, within(0, 10),
                                       "Holes in a room's plan that are no wider, both ways, are columns."),
      param<&Params::boundaries>("Write space boundaries.")};
  static void run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::building
