#include "modules/building/write_ifc.hpp"

#include <fmt/format.h>

#include "graph/api/write_output.hpp"
#include "modules/building/ifc_context.hpp"
#include "modules/building/step_reader.hpp"
#include "modules/building/upright_building.hpp"
#include "modules/types/building_rules.hpp"
#include "modules/types/crs_name.hpp"

namespace atrium::building {
namespace {

/// How many openings no wall or slab was found for.
std::size_t without_host(const Building& building, const Elements& elements) {
  std::size_t hosted = 0;
  for (const auto& wall : elements.walls)
    for (const auto& hole : wall.holes) hosted += hole.main ? 1 : 0;
  for (const auto& slab : elements.slabs) hosted += slab.openings.size();
  return building.openings.size() - hosted;
}

void check_furniture(const Mesh& mesh) {
  for (const auto& v : mesh.vertices)
    if (!v.allFinite()) throw Error("a vertex of the furniture is not finite");
  for (const auto& triangle : mesh.triangles)
    for (const auto v : triangle)
      if (v >= mesh.vertices.size()) throw Error(fmt::format("the furniture has no vertex {}", v));
}

}  // namespace

void WriteIfc::run(const In& in, const Params& params, Context& context) {
  check(*in.building);
  const Transform transform = in.transform ? *in.transform : Transform{};
  const std::string crs = crs_of(params.crs, in.scan.get(), transform, "building", context);
  const UprightBuilding upright = upright_building(*in.building, transform, crs.empty());
  if (upright.building.rooms.empty()) context.warn("the building has no rooms: the file has no elements");
  const Elements elements =
      elements_of(upright.building, {params.max_thickness, params.max_slab_thickness, params.assumed_thickness,
                                     params.assumed_slab_thickness, params.max_column_width});
  if (const std::size_t count = without_host(upright.building, elements); count > 0)
    context.warn(fmt::format("{} of {} openings lie in no wall or slab: their doors and windows stand by themselves",
                             count, upright.building.openings.size()));
  Mesh furniture;
  if (in.furniture) {
    check_furniture(*in.furniture);
    furniture = transformed(*in.furniture, upright.turn);
  }
  const std::string text = ifc_text(upright.building, elements, in.furniture ? &furniture : nullptr,
                                    {std::filesystem::path(params.path.path).filename().string(), params.project, crs,
                                     params.id_space, params.boundaries});
  check_ifc(read_step(text));
  write_output(context, params.path.path, text);
}

}  // namespace atrium::building
