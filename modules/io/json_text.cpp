#include "modules/io/json_text.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace atrium::io {

using Json = JsonField::Json;

std::string json_text(const Json& root, std::initializer_list<std::string_view> long_lists) {
  const auto dump = [](const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); };
  std::string text = "{";
  for (const auto& [key, value] : root.items()) {
    text += (text.size() > 1 ? ",\n" : "\n") + Json(key).dump() + ": ";
    if (std::find(long_lists.begin(), long_lists.end(), key) == long_lists.end()) {
      text += dump(value);
      continue;
    }
    text += "[";
    for (std::size_t i = 0; i < value.size(); ++i) text += (i > 0 ? ",\n " : "\n ") + dump(value[i]);
    text += "]";
  }
  return text + "\n}\n";
}

Json json_of(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }
Json json_of(const std::vector<Eigen::Vector3d>& ring) {
  Json list = Json::array();
  for (const auto& p : ring) list.push_back(json_of(p));
  return list;
}

SurfaceClass class_of(const JsonField& field) {
  const auto name = field.text();
  for (const auto c : {SurfaceClass::wall, SurfaceClass::floor, SurfaceClass::ceiling, SurfaceClass::object})
    if (name == name_of(c)) return c;
  field.fail("is '" + name + "'", "classes are wall, floor, ceiling, object");
}

}  // namespace atrium::io
