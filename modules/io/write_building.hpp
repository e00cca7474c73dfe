#pragma once
#include "graph/api/node.hpp"
#include "modules/types/building.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/metrics.hpp"

namespace atrium::io {

/// Writes a building as JSON (share/schema/building.schema.json); io.read_building reads it back, bit by bit.
///
///     {"atrium_building": 1, "units": "m", "up": [0, 0, 1], "origin": [x, y, z],
///      "scan_unit": {"name": "ft", "metres": 0.3048}, "confidence": 0.9, "doubts": [text, …],
///      "accuracy": {"all": {"points": 90211, "median": m, "rms": m, "p95": m}, "wall": {…}, "area": {"loa30": 0.4,
///      …}}, "storeys":  [{"elevation": 0, "height": 2.5}, …], "rooms":    [{"name": "room 1", "storey": 0, "area": m²,
///      "height": m, "volume": m³, "faces": [0, …],
///                    "outline": [place, …], "holes": [[place, …], …],
///                    "confidence": 0.8, "doubts": ["its floor was not seen", …]}, …],
///      "faces":    [{"class": "wall", "storey": 0, "room": 0, "area": m², "normal": [x, y, z], "offset": d,
///                    "primitive": 3, "inferred": false, "observed": 0.93, "residual": 0.004,
///                    "outline": [vertex, …], "holes": [[vertex, …], …]}, …],
///      "openings": [{"kind": "door", "room_a": 0, "room_b": 1, "face_a": 3, "face_b": 9, "thickness": 0.1,
///                    "position": place, "width": 0.9, "height": 2.1, "outline_a": [place, …], "outline_b": […]}, …],
///      "walls":    [{"face_a": 3, "face_b": 9, "thickness": 0.1, "area": m²}, …],
///      "vertices": [place, …]}
///
/// A place is [x, y, z] relative to the origin, which is written apart, so that a georeferenced building keeps its
/// millimetres. The frame is that of the building, or with `transform` the one from which that leads to it: the input's
/// of a pipeline. `up` is a unit vector in it; elevations count along it from the origin. Faces list their corners as
/// indices into `vertices`, counter-clockwise seen from the room, holes clockwise; normal · place + offset = 0. All is
/// numbered from 0; −1 is none (outside, or not known). `inferred` faces have no primitive; `area` (without holes) of a
/// face, `position` (the middle of outline_a), `width` and `height` of an opening are there for those who read the
/// file: they follow from the rest. `holes` are left out where there are none, `confidence` (0 to
/// 1) and `doubts` where nobody has judged the rooms (layout.confidence does).
///
/// All lengths are in metres. `scan_unit` (with `scan`) says in which unit the scan's file was read: its name, and
/// metres per unit; places in the file are places here divided by that. `accuracy` (with that input) has the totals of
/// building.accuracy: how far the scan's points are from the model, by class, and which share of the faces' area is in
/// which band; it is not read back.
///
/// Errors: numbers that are not finite, indices of what is not there; a folder that cannot be written. Then no file is
/// there.
struct WriteBuilding {
  static constexpr std::string_view type = "io.write_building";
  static constexpr std::string_view summary = "Writes a building (storeys, rooms, faces, openings, walls) as JSON.";
  struct In {
    Input<Building> building;
    OptionalInput<Transform> transform;
    OptionalInput<Cloud> scan;
    OptionalInput<Metrics> accuracy;
  };
  struct Params {
    OutputPath path{"building.json"};
  };
  static constexpr auto inputs =
      std::tuple{port<&In::building>("What is written."),
                 port<&In::transform>("From the frame that is wanted to that of the building."),
                 port<&In::scan>("The scan that it was made from: the unit of its file is named."),
                 port<&In::accuracy>("What building.accuracy says of it in all.")};
  static constexpr auto params = std::tuple{param<&Params::path>("The JSON file.")};
  static void run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::io
