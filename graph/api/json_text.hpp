#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace atrium {

// The JSON library's parser and writer are compiled here alone: they cost two seconds in each file that calls them.

/// The value as text, on one line (indent −1) or with so many blanks a level; broken UTF-8 becomes U+FFFD.
std::string json_text(const nlohmann::ordered_json& json, int indent = -1);

/// The value of a text; is_discarded() is true of it if the text is no JSON.
nlohmann::ordered_json read_json(std::string_view text);
/// The same of a file; discarded too if the file cannot be read.
nlohmann::ordered_json read_json_file(const std::filesystem::path& file);

}  // namespace atrium
