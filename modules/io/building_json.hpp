#pragma once
#include <optional>
#include <string>

#include "modules/io/json_fields.hpp"
#include "modules/types/building.hpp"
#include "modules/types/metrics.hpp"

namespace atrium::io {

/// building.json, as io.write_building documents it. `up` is what is up in the building's coordinates; `scan_unit`,
/// metres per unit of the scan's file, is written if it is given, and so are the totals of building.accuracy.
/// Throws Error for numbers that are not finite, and for indices of what is not there.
std::string building_to_json(const Building& building, const Eigen::Vector3d& up,
                             std::optional<double> scan_unit = std::nullopt, const Metrics* accuracy = nullptr);

struct ReadBack {
  Building building;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
};
ReadBack building_from_json(const JsonField& root);

}  // namespace atrium::io
