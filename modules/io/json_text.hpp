#pragma once
#include <initializer_list>
#include <string>
#include <string_view>

#include "modules/io/json_fields.hpp"
#include "modules/types/structure.hpp"

namespace atrium::io {

/// The object as text, a key to a line; of the lists named by `long_lists` an entry to a line: small, and a difference
/// between two files can be read. Numbers are the shortest that give the same double back; broken UTF-8 becomes U+FFFD.
std::string json_text(const JsonField::Json& root, std::initializer_list<std::string_view> long_lists);

/// [x, y, z], and a list of such.
JsonField::Json json_of(const Eigen::Vector3d& p);
JsonField::Json json_of(const std::vector<Eigen::Vector3d>& ring);
/// "wall", "floor", "ceiling" or "object"; anything else is an error with its place.
SurfaceClass class_of(const JsonField& field);

}  // namespace atrium::io
