#pragma once
#include "graph/api/node.hpp"
#include "modules/types/building.hpp"
#include "modules/types/cloud.hpp"

namespace atrium::building {

/// Writes a building as CityJSON 2.0 (the community standard OGC 20-072r5), for geographic information systems and city
/// models.
///
/// What is in it: a Building, a BuildingStorey per storey as its child, a BuildingRoom per room as the storey's. A room
/// is a Solid of LoD 3: its closed surface, seen from outside of the room's air, one polygon per face, which is an
/// InteriorWallSurface, a FloorSurface or a CeilingSurface. Openings are polygons of their own in it, cut out of their
/// faces: Door, Window, and ClosureSurface for passages and holes in slabs; `parent` and `children` join them with
/// their faces. Corners of an opening on the edge of a face are corners of the face beside it too, so that the surface
/// closes. A room whose surface closes only without its openings is written without them, with a warning; one that
/// closes neither way is a MultiSurface, without openings too, with a warning. Walls between rooms are not in it: their
/// two faces are (IFC has the walls).
///
/// Attributes: of storeys sortKey (0 the lowest), elevation_m, height_m; of rooms name, area_m2, height_m, volume_m3,
/// and confidence and doubts where they are known; of surfaces face (its number in building.json), observed (share of
/// its area that points cover), inferred; of openings opening (its number there).
///
/// Metres, z up, whole tenths of a millimetre (`transform`); no corner is there twice, or without use. Ids are
/// "building", "storey-0", "room-0", … `metadata` has the extent and, where a coordinate reference system is known
/// (`crs`, or that of `scan`) and has an EPSG code, its address as referenceSystem; one without a code, and one that
/// the building is turned out of by more than 10 degrees to be upright, is left out with a warning.
///
/// A building without rooms gives a file without rooms, and a warning. Errors: numbers that are not finite, indices of
/// what is not there; a name that is no coordinate reference system; a folder that cannot be written. Then no file is
/// there. Cost: O(n²) per room of n corners.
struct WriteCityjson {
  static constexpr std::string_view type = "building.write_cityjson";
  static constexpr std::string_view summary = "Writes a building as CityJSON 2.0: storeys, rooms, their surfaces.";
  struct In {
    Input<Building> building;
    OptionalInput<Transform> transform;
    OptionalInput<Cloud> scan;
  };
  struct Params {
    OutputPath path{"building.city.json"};
    std::string title = "Building";
    std::string crs;
  };
  static constexpr auto inputs =
      std::tuple{port<&In::building>("What is written."),
                 port<&In::transform>("From the frame that is wanted to that of the building."),
                 port<&In::scan>("The scan that it was made from: its coordinate reference system.")};
  static constexpr auto params = std::tuple{
      param<&Params::path>("The file, in the run's folder."), param<&Params::title>("The data set's title."),
      param<&Params::crs>("Coordinate reference system of the input: EPSG:25832; empty: that of `scan`, or local.")};
  static void run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::building
