#include "modules/io/ply_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bitset>
#include <cmath>

#include "graph/api/error.hpp"
#include "graph/api/text.hpp"
#include "modules/io/free_numbers.hpp"

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

PlyPart part_of(const std::string& path, const PlyElement& element) {
  if (element.name == "vertex") return PlyPart::vertices;
  if (element.name == "face") return PlyPart::faces;
  if (element.name == "tristrips") return PlyPart::strips;
  if (is_sensors(path, element)) return PlyPart::sensors;
  return element.name == "camera" && !element.has_lists() && element.count > 0 ? PlyPart::camera : PlyPart::other;
}

void warn_of_unread(const std::string& path, const PlyElement& element, const Context& context) {
  const bool has_corners = std::any_of(element.properties.begin(), element.properties.end(), is_corner_list);
  const bool is_face = element.name == "face" || element.name == "tristrips";
  // range_grid: the vertices are the image's points, and no surface is said to be between them.
  if (element.count == 0 || has_corners == is_face || element.name == "vertex" || element.name == "range_grid") return;
  context.warn(fmt::format("{}: {} of element '{}' not read: {}", path, counted(element.count, "record"), element.name,
                           is_face ? "they have no list 'vertex_indices' of corners"
                                   : "faces are read of the elements 'face' and 'tristrips'"));
}

std::optional<std::string> one_record_a_line(std::string_view body, const PlyHeader& header) {
  FreeNumbers numbers(body);
  for (const auto& element : header.elements) {
    if (element.properties.empty()) continue;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const auto& property : element.properties) {
        double value = 0;
        if (!numbers.take(value)) return std::nullopt;
        if (!property.is_list()) continue;
        if (!(value >= 0) || value != std::floor(value)) return std::nullopt;
        for (double left = value; left > 0; --left)
          if (double item = 0; !numbers.take(item)) return std::nullopt;
      }
      numbers.end_record();
    }
  }
  return numbers.text();
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
