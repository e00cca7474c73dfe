#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "graph/run/runner.hpp"

namespace atrium {

/// A word that is no status means `cancelled`.
NodeStatus read_node_status(std::string_view text);

/// All of it, to be read back by another process. Reading throws nlohmann::json::exception.
nlohmann::ordered_json record_json(const NodeRecord& record);
NodeRecord read_record_json(const nlohmann::ordered_json& json);

}  // namespace atrium
