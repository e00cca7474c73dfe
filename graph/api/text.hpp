#pragma once
#include <cstddef>
#include <ctime>
#include <string>
#include <string_view>
#include <vector>

namespace atrium {

/// Characters (code points) of a UTF-8 text: its width, as nothing that is printed here is wider.
std::size_t count_characters(std::string_view text);
/// The first so many of them.
std::string shortened(std::string_view text, std::size_t characters);

/// A count and what it counts: "1 node", "2 nodes", or `many` where that is not `one` with an s, as in "2 points lie".
std::string counted(std::size_t count, std::string_view one, std::string_view many = {});

/// The text with every `from` replaced by `to`.
std::string replaced(std::string_view text, std::string_view from, std::string_view to);

/// Place of the first byte that does not belong to a UTF-8 text (control characters but tab and carriage return,
/// overlong forms, surrogates, stray bytes), or npos.
std::size_t first_not_text(std::string_view text);

/// Lines of columns, each as wide as its widest cell, with two blanks between them. `right[c]`: column c is aligned to
/// the right; those that it does not name are to the left.
std::string aligned(const std::vector<std::vector<std::string>>& rows, const std::vector<bool>& right = {},
                    std::string_view indent = "");

/// "2024-01-31T09:30:00Z" (ISO 8601, UTC).
std::string utc_text(std::time_t time = std::time(nullptr));

/// What this machine calls itself.
std::string host_name();

}  // namespace atrium
