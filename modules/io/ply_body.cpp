#include "modules/io/ply_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bitset>

#include "graph/api/error.hpp"

namespace atrium::io {

std::vector<Role> roles_of(const PlyElement& element) {
  std::vector<Role> roles;
  for (const auto& p : element.properties) {
    Role role = p.is_list() ? Role::none : role_of(p.name);
    // Only PCD packs colours into one number.
    if (role == Role::packed_colour || std::find(roles.begin(), roles.end(), role) != roles.end()) role = Role::none;
    roles.push_back(role);
  }
  return roles;
}

bool is_corner_list(const PlyProperty& property) {
  return property.is_list() && (property.name == "vertex_indices" || property.name == "vertex_index");
}

int viewpoint_axis(const PlyProperty& property) {
  if (property.is_list()) return -1;
  if (property.name == "view_px") return 0;
  if (property.name == "view_py") return 1;
  return property.name == "view_pz" ? 2 : -1;
}

int sensor_axis(const PlyProperty& property) {
  if (property.name == "x") return 0;
  if (property.name == "y") return 1;
  return property.name == "z" ? 2 : -1;
}

bool is_sensors(const std::string& path, const PlyElement& element) {
  constexpr std::uint64_t most = 65536;  // `source` has 16 bits
  if (element.name != "sensor" || element.has_lists()) return false;
  std::bitset<3> has;
  for (const auto& property : element.properties)
    if (const int axis = sensor_axis(property); axis >= 0) has.set(static_cast<std::size_t>(axis));
  if (has.all() && element.count > most)
    throw Error(fmt::format("{}: {} sensors; the most that can be handled are {}", path, element.count, most));
  return has.all();
}

}  // namespace atrium::io
