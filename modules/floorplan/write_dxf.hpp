#pragma once
#include "graph/api/node.hpp"
#include "modules/floorplan/units.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/floor_plan.hpp"

namespace atrium::floorplan {

/// Writes a floor plan as DXF (release 2000, text), for CAD programs: in the frame of the plan with its true offsets,
/// in the plane z = 0. Coordinates are in metres ($INSUNITS 6) or, with `units`, in millimetres (4) or inches (1, with
/// architectural units: 11'-4 1/2"; areas in square feet).
///
/// Layers, after the CAD layer guidelines of the American Institute of Architects:
///
/// | layer | holds |
/// |---|---|
/// | A-WALL | what the walls of known thickness cover, joined |
/// | A-WALL-CNTR | their middle lines |
/// | A-WALL-FACE | faces of walls of unknown thickness |
/// | A-WALL-INFR | walls that are inferred: none of their faces was seen |
/// | A-FLOR, A-CLNG | floors and ceilings |
/// | A-DOOR | doors: gap, leaf open at a right angle, its sweep (which way it goes is custom, not measured) |
/// | A-GLAZ | windows: gap and panes |
/// | A-FLOR-OVHD | holes in floors (crossed) and in the ceiling above |
/// | A-AREA, A-AREA-IDEN | outlines of rooms; their names, areas and heights |
/// | A-ANNO-DIMS | dimensions outside of the building: DIMENSION entities of the style ATRIUM |
/// | A-ANNO-REVS | diamonds on what was corrected by hand, if anything was: at its middle, or over a room's name |
/// | A-ANNO-NOTE | which coordinate reference system the coordinates are in, if that is known |
///
/// Polygons are closed LWPOLYLINEs, holes have one of their own. If the plan has several storeys, each has its own
/// layers: A-WALL-S0, A-WALL-S1, … (0 the lowest); they lie above each other, as in the building. Coordinates have all
/// digits of a double; text is in the code page Windows-1252, other characters are written as \U+XXXX.
///
/// Dimensions are measured by the CAD program: they follow when their points are moved. Until then it shows the lines
/// and the text that the file has for each, a block *D1, *D2, …; texts without room between their lines stand aside.
///
/// DXF of that release has no place for a coordinate reference system, and readers of later ones ignore theirs. So its
/// name (`crs`, or that of `scan`) is a text below the drawing and a comment (group 999) at the file's beginning.
///
/// A plan without storeys gives a valid file without entities, and a warning. Errors: no such storey; a name that is no
/// coordinate reference system; a folder or disk that cannot be written; then no file is there.
struct WriteDxf {
  static constexpr std::string_view type = "floorplan.write_dxf";
  static constexpr std::string_view summary = "Writes a floor plan as DXF, for CAD programs.";
  struct In {
    Input<FloorPlan> plan;
    OptionalInput<Cloud> scan;
  };
  struct Params {
    OutputPath path{"floorplan.dxf"};
    std::int32_t storey = -1;
    std::int32_t scale = 100;
    bool dimensions = true;
    Units units = Units::metres;
    std::string crs;
  };
  static constexpr auto inputs =
      std::tuple{port<&In::plan>("What to write."),
                 port<&In::scan>("The scan that it was made from: its coordinate reference system.")};
  static constexpr auto params = std::tuple{
      param<&Params::path>("The file, in the run's folder."),
      param<&Params::storey>(count, within(-1, 10000), "The storey to write, 0 the lowest; -1: all of them."),
      param<&Params::scale>(unitless, within(1, 100000),
                            "The scale at which it will be plotted, 100 for 1:100: sizes texts and dimensions only."),
      param<&Params::dimensions>("Write the chains of dimensions."),
      param<&Params::units>(unit_choices,
                            "Unit of the coordinates and of the texts; of ft-in the coordinates are in inches."),
      param<&Params::crs>("Coordinate reference system of the input: EPSG:25832; empty: that of `scan`, or local."),
  };
  static void run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::floorplan
