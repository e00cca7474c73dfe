#pragma once
#include <initializer_list>
#include <string>
#include <string_view>

#include "modules/io/json_fields.hpp"

namespace atrium::io {

/// The object as text, a key to a line; of the lists named by `long_lists` an entry to a line: small, and a difference
/// between two files can be read. Numbers are the shortest that give the same double back; broken UTF-8 becomes U+FFFD.
std::string json_text(const JsonField::Json& root, std::initializer_list<std::string_view> long_lists);

/// The JSON of a file. Errors name the file, and the line and column of what is no JSON.
JsonField::Json parsed_json(const std::string& path);

}  // namespace atrium::io
