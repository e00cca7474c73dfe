#pragma once
#include <nlohmann/json_fwd.hpp>

namespace atrium::cli {

/// The JSON schema (draft 2020-12) of sweep files.
nlohmann::ordered_json sweep_schema();

}  // namespace atrium::cli
