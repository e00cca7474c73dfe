#include "modules/io/write_building.hpp"

#include "graph/api/write_output.hpp"
#include "modules/io/building_json.hpp"

namespace atrium::io {

void WriteBuilding::run(const In& in, const Params& params, Context& context) {
  std::string text;
  const std::optional<double> unit = in.scan ? std::optional(in.scan->unit) : std::nullopt;
  const Metrics* accuracy = in.accuracy ? &*in.accuracy : nullptr;
  if (in.transform) {
    const Transform back = inverse(*in.transform);
    text = building_to_json(transformed(*in.building, back), back.rotation * Eigen::Vector3d::UnitZ(), unit, accuracy);
  } else {
    text = building_to_json(*in.building, Eigen::Vector3d::UnitZ(), unit, accuracy);
  }
  write_output(context, params.path.path, text);
}

}  // namespace atrium::io
