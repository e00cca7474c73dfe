#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "modules/types/structure.hpp"

namespace atrium::io {

/// The name of an OBJ group of one class and source primitive (-1: none): "wall_12", "object".
std::string group_name(SurfaceClass surface, std::int32_t primitive);

/// Reads a group's name back. False if it is not of that form.
bool parse_group_name(std::string_view name, SurfaceClass& surface, std::int32_t& primitive);

}  // namespace atrium::io
