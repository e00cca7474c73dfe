#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/floor_plan.hpp"

namespace atrium::floorplan {

/// Writes a floor plan as GeoJSON (RFC 7946), for geographic information systems: one FeatureCollection of all storeys.
///
/// Features, each with the properties `class` and `storey`: "room" (Polygon; name, area_m2, height_m, elevation_m,
/// confidence 0 to 1), "wall" (Polygon between two faces, thickness_m, length_m; LineString where only one face is
/// known, thickness_m null; inferred: none of its faces was seen), "door", "passage"
/// and "window" (Polygon in the wall, LineString where only one of its faces is known; rooms: the names of those left
/// and right, null outside; width_m, height_m, sill_m over the floor, thickness_m), "slab" (Polygon: a hole in the
/// floor, or at sill_m over it), "floor" and "ceiling" (Polygon; area_m2). Walls and openings that were corrected by
/// hand, and rooms of which a floor or a ceiling was, have `corrected` true; others do not have it. Outer rings run
/// counter-clockwise, holes clockwise, the first corner is repeated at the end. Coordinates are metres in the frame of
/// the plan, rounded to a tenth of a millimetre, with their true offsets (easting and northing of a georeferenced
/// scan). RFC 7946 knows longitude and latitude in WGS 84 only, unless both sides agree on another system (§4): these
/// are not turned into degrees, so that lengths stay lengths. Where the system is known (`crs`, or that of `scan`) and
/// has an EPSG code, the member "crs" of GeoJSON 2008 names it, which GDAL, QGIS and most others still read; the
/// collection's "frame" names it too. One without a code is in "frame" only, with a warning; where there is none,
/// "name" says so. A plan that was turned upright by more than 10 degrees is in none, with a warning. All else is by
/// RFC 7946. Where a height, an elevation or a confidence is not known it is null.
///
/// A plan without storeys gives an empty collection, and a warning. Errors: a name that is no coordinate reference
/// system; a folder that cannot be written; then no file is there.
struct WriteGeojson {
  static constexpr std::string_view type = "floorplan.write_geojson";
  static constexpr std::string_view summary = "Writes a floor plan as GeoJSON: rooms, walls, floors, ceilings.";
  struct In {
    Input<FloorPlan> plan;
    OptionalInput<Cloud> scan;
  };
  struct Params {
    OutputPath path{"floorplan.geojson"};
    std::string crs;
  };
  static constexpr auto inputs =
      std::tuple{port<&In::plan>("What to write."),
                 port<&In::scan>("The scan that it was made from: its coordinate reference system.")};
  static constexpr auto params = std::tuple{
      param<&Params::path>("The file, in the run's folder."),
      param<&Params::crs>("Coordinate reference system of the input: EPSG:25832; empty: that of `scan`, or local.")};
  static void run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::floorplan
