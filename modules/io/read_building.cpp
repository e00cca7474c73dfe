#include "modules/io/read_building.hpp"

#include <Eigen/Geometry>

#include "modules/io/building_json.hpp"
#include "modules/types/turn_between.hpp"

namespace atrium::io {

ReadBuilding::Out ReadBuilding::run(const Params& params, Context& context) {
  const JsonFile file(params.path.path);
  auto [building, up] = building_from_json(file.root());
  if (building.rooms.empty()) context.warn(params.path.path + ": there is no room in it");
  Out out;
  if (up == Eigen::Vector3d::UnitZ()) {
    out.building = std::move(building);
  } else {
    out.transform.rotation = turn_between(up, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    out.building = transformed(building, out.transform);
  }
  return out;
}

}  // namespace atrium::io
