#include "modules/building/correct.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "graph/api/text.hpp"
#include "modules/building/corrections.hpp"
#include "modules/building/room_measures.hpp"
#include "modules/types/building_rules.hpp"

namespace atrium::building {

void apply_all(CorrectionDraft& draft, const std::vector<Correction>& corrections) {
  using Apply = void (*)(CorrectionDraft&, const Correction&);
  static constexpr std::array<std::pair<std::string_view, Apply>, 11> all{{{"rename_room", rename_room},
                                                                           {"merge_rooms", merge_rooms},
                                                                           {"split_room", split_room},
                                                                           {"add_opening", add_opening},
                                                                           {"change_opening", change_opening},
                                                                           {"drop_opening", drop_opening},
                                                                           {"move_wall", move_wall},
                                                                           {"set_thickness", set_thickness},
                                                                           {"drop_face", drop_face},
                                                                           {"set_ceiling", set_ceiling},
                                                                           {"set_floor", set_floor}}};
  bool shapes = false, floors = false;
  for (const auto& correction : corrections) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const auto& row) { return row.first == correction.name; });
    found->second(draft, correction);
    if (correction.name == "rename_room") continue;
    check_thicknesses(draft, correction);
    shapes = true;
    floors = floors || correction.name == "set_floor";
  }
  if (shapes) settle_building(draft, floors);
}

Correct::Out Correct::run(const In& in, const Params& params, Context& context) {
  if (params.paths.empty()) return {in.building};
  check(*in.building);
  std::vector<Correction> corrections;
  for (const auto& path : params.paths) {
    const auto more = read_corrections(path.path);
    if (more.empty()) context.warn(path.path + ": there is no correction in it");
    corrections.insert(corrections.end(), more.begin(), more.end());
  }
  if (corrections.empty()) return {in.building};
  CorrectionDraft draft(*in.building, in.transform ? *in.transform : Transform{}, in.scan ? in.scan->unit : 1,
                        params.max_thickness);
  apply_all(draft, corrections);
  check(draft.building);
  context.info(fmt::format("{}: {}, {}, {}", counted(corrections.size(), "correction"),
                           counted(draft.building.rooms.size(), "room"), counted(draft.building.faces.size(), "face"),
                           counted(draft.building.openings.size(), "opening")));
  return {std::make_shared<const Building>(std::move(draft.building))};
}

}  // namespace atrium::building
