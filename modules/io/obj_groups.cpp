#include "modules/io/obj_groups.hpp"

#include <charconv>

#include "modules/io/surface_classes.hpp"

namespace atrium::io {

std::string group_name(SurfaceClass surface, std::int32_t primitive) {
  std::string name(name_of(surface));
  return primitive < 0 ? name : name + "_" + std::to_string(primitive);
}

bool parse_group_name(std::string_view name, SurfaceClass& surface, std::int32_t& primitive) {
  for (const SurfaceClass c : all_classes) {
    const std::string_view word = name_of(c);
    if (!name.starts_with(word)) continue;
    std::string_view number = name.substr(word.size());
    std::int32_t value = -1;
    if (!number.empty()) {
      if (!number.starts_with('_')) return false;
      number.remove_prefix(1);
      const auto [stop, error] = std::from_chars(number.data(), number.data() + number.size(), value);
      if (error != std::errc{} || stop != number.data() + number.size() || value < 0) return false;
    }
    surface = c;
    primitive = value;
    return true;
  }
  return false;
}

}  // namespace atrium::io
