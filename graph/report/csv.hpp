#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace atrium::report {

/// The rows of a CSV text (RFC 4180).
std::vector<std::vector<std::string>> read_csv(std::string_view text);

}  // namespace atrium::report
