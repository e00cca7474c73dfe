#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "modules/io/lines.hpp"

namespace atrium::io {

/// How a text file of columns writes them.
struct TextDialect {
  char separator = ' ';        ///< ' ': any blanks; else ',', ';' or a tab, between which a field may be empty
  bool decimal_comma = false;  ///< "1,5" is one and a half
};

/// Takes the next field, without blanks around it and without quotes. False at the end of the line.
bool next_field(std::string_view& line, const TextDialect& dialect, std::string_view& field);
/// All fields of a line.
std::vector<std::string_view> fields_of(std::string_view line, const TextDialect& dialect);

/// The dialect that some lines are written in. Decimal commas: where ';' or tabs or blanks separate numbers of which no
/// one has more than one comma, and that within.
TextDialect dialect_of(const std::vector<std::string_view>& lines);

/// parse_number for a field of the dialect; an empty one is NaN.
bool parse_field(std::string_view field, const TextDialect& dialect, double& value);

}  // namespace atrium::io
