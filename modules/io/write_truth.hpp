#pragma once
#include "graph/api/node.hpp"
#include "modules/types/ground_truth.hpp"

namespace atrium::io {

/// Writes the exact truth of a simulated scene as JSON; io.read_layout reads it back, bit by bit.
///
///     {"atrium_truth": 1, "units": "m", "origin": [x, y, z],
///      "rooms":    [{"name": "hall", "storey": 0, "outline": ring}, …],
///      "faces":    [{"class": "wall", "storey": 0, "room": 0, "normal": [x, y, z], "offset": d, "outline": ring,
///                    "holes": [ring, …]}, …],
///      "openings": [{"kind": "door", "room_a": 0, "room_b": 1, "face_a": 3, "face_b": 9, "thickness": 0.1,
///                    "outline": ring}, …],
///      "mesh":     {"vertices": [[x, y, z], …], "triangles": [[a, b, c], …], "faces": [face of each triangle],
///                   "colours": [[r, g, b], …]}}
///
/// A ring is a list of [x, y, z], relative to the origin, its first corner not repeated. Rooms' outlines run
/// counter-clockwise from above, faces' and openings' seen from the room (room_a), holes clockwise; a face's plane is
/// normal · place + offset = 0, its normal into the room. Rooms and faces are numbered from 0; −1 is none (outside).
/// `holes` and `mesh` may be missing: then the face has none, and the faces are cut into triangles on reading.
struct WriteTruth {
  static constexpr std::string_view type = "io.write_truth";
  static constexpr std::string_view summary = "Writes ground truth (rooms, faces, openings) as JSON.";
  struct In {
    Input<GroundTruth> truth;
  };
  struct Params {
    OutputPath path{"truth.json"};
  };
  static constexpr auto inputs = std::tuple{port<&In::truth>("What is written.")};
  static constexpr auto params = std::tuple{param<&Params::path>("The JSON file.")};
  static void run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::io
