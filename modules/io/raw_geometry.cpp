#include "modules/io/raw_geometry.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include "graph/api/error.hpp"

namespace atrium::io {
namespace {

constexpr std::pair<std::string_view, Role> names[] = {
    {"x", Role::x},
    {"y", Role::y},
    {"z", Role::z},
    {"nx", Role::nx},
    {"ny", Role::ny},
    {"nz", Role::nz},
    {"normal_x", Role::nx},
    {"normal_y", Role::ny},
    {"normal_z", Role::nz},
    {"normalx", Role::nx},
    {"normaly", Role::ny},
    {"normalz", Role::nz},
    {"red", Role::red},
    {"green", Role::green},
    {"blue", Role::blue},
    {"r", Role::red},
    {"g", Role::green},
    {"b", Role::blue},
    {"rf", Role::red},
    {"gf", Role::green},
    {"bf", Role::blue},
    {"rgb", Role::packed_colour},
    {"rgba", Role::packed_colour},
    {"intensity", Role::intensity},
    {"i", Role::intensity},
    {"reflectance", Role::intensity},
    {"reflectivity", Role::intensity},
    {"label", Role::label},
    {"class", Role::label},
    {"classification", Role::label},
    {"source", Role::source},
};

}  // namespace

Role role_of(std::string_view name) {
  std::string lower(name);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  std::string_view key = lower;
  key = key.substr(0, key.find_first_of("[("));  // a unit, as in "X [m]"
  while (!key.empty() && key.back() == ' ') key.remove_suffix(1);
  for (const std::string_view prefix : {"scalar_", "diffuse_", "vertex_"})
    if (key.starts_with(prefix)) key.remove_prefix(prefix.size());
  for (const auto& [known, role] : names)
    if (known == key) return role;
  return Role::none;
}

void Table::attach(std::shared_ptr<Table> table, RawGeometry& geometry) {
  const std::size_t width = table->width();
  for (std::size_t c = 0; c < width; ++c) {
    if (table->roles_[c] == Role::none) continue;
    const auto* first = reinterpret_cast<const std::byte*>(table->values_.data() + c);
    geometry.column(table->roles_[c]) = {first, width * sizeof(double), Scalar::f64, false};
  }
  geometry.storage.push_back(std::move(table));
}

void load_rows(RawGeometry& geometry, const Context& context) {
  if (!geometry.rows) return;
  Table::attach(geometry.rows->read_all(context), geometry);
  geometry.rows = nullptr;
}

void drop_pages(const RawGeometry& geometry) {
  for (const auto& file : geometry.files) file->drop_pages();
}

void require_position(const RawGeometry& geometry, std::string_view names_there) {
  for (const Role role : {Role::x, Role::y, Role::z})
    if (!geometry.column(role))
      throw Error(geometry.path + ": the points have no coordinates x, y, z (there are: " + std::string(names_there) +
                  ")");
}

}  // namespace atrium::io
