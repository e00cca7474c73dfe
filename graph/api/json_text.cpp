#include "graph/api/json_text.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

namespace atrium {

using Json = nlohmann::ordered_json;

std::string json_text(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

Json read_json(std::string_view text) { return Json::parse(text, nullptr, false); }

Json read_json_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return Json::parse(stream, nullptr, false);
}

}  // namespace atrium
