#pragma once
#include "graph/api/node.hpp"
#include "modules/types/building.hpp"

namespace atrium::io {

/// Reads a building.json that io.write_building wrote, bit by bit, or one that another program wrote after
/// share/schema/building.schema.json.
///
/// A building has z up: one from a file with another `up` is turned by the least rotation about the file's zero, and
/// `transform` is that rotation, so that what takes both (layout.mesh, metric.openings) gives the file's frame back.
///
/// Errors, naming the place in the file: no JSON (line and column), no building, a missing or misshapen value, an index
/// of what is not there, other units than metres, another version.
struct ReadBuilding {
  static constexpr std::string_view type = "io.read_building";
  static constexpr std::string_view summary = "Reads a building from JSON, as io.write_building writes it.";
  struct Out {
    Building building;
    Transform transform;
  };
  struct Params {
    InputPath path;
  };
  static constexpr auto outputs = std::tuple{port<&Out::building>("Closed rooms, z up."),
                                             port<&Out::transform>("From the file's frame to that of the building.")};
  static constexpr auto params = std::tuple{param<&Params::path>("The JSON file.")};
  static Out run(const Params& params, Context& context);
};

}  // namespace atrium::io
