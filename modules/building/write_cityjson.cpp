#include "modules/building/write_cityjson.hpp"

#include <fmt/format.h>

#include "graph/api/write_output.hpp"
#include "modules/building/city_model.hpp"
#include "modules/building/upright_building.hpp"
#include "modules/types/building_rules.hpp"
#include "modules/types/crs_name.hpp"

namespace atrium::building {

void WriteCityjson::run(const In& in, const Params& params, Context& context) {
  check(*in.building);
  const Transform transform = in.transform ? *in.transform : Transform{};
  const std::string crs = crs_of(params.crs, in.scan.get(), transform, "building", context);
  const int epsg = epsg_code(crs);
  if (!crs.empty() && epsg == 0)
    context.warn(
        fmt::format("CityJSON names coordinate reference systems by their EPSG code: '{}' is not written", crs));
  const UprightBuilding upright = upright_building(*in.building, transform, crs.empty());
  if (upright.building.rooms.empty()) context.warn("the building has no rooms: the file has none");
  const CityModel model = city_model(upright.building, {params.title, epsg});
  for (const auto& warning : model.warnings) context.warn(warning);
  write_output(context, params.path.path, model.text);
}

}  // namespace atrium::building
