#pragma once
#include <string>
#include <vector>

namespace atrium {

/// A table of texts.
struct Table {
  struct Column {
    enum class Kind { text, axis, drawn, metric };  ///< drawn: what a random sample sets
    std::string title;                              ///< with its unit: "time [s]"
    Kind kind = Kind::text;
    std::string name = title, unit = {};
    bool is_number() const { return kind == Kind::metric; }  ///< aligned to the right
  };
  std::vector<Column> columns;
  std::vector<std::vector<std::string>> rows;
};

std::string as_text(const Table& table);      ///< aligned columns
std::string as_csv(const Table& table);       ///< RFC 4180, with "\n"
std::string as_markdown(const Table& table);  ///< a GitHub table

}  // namespace atrium
