#pragma once
#include <string>
#include <vector>

namespace atrium {

/// A table of texts.
struct Table {
  struct Column {
    std::string title;
    bool number = false;  ///< aligned to the right
  };
  std::vector<Column> columns;
  std::vector<std::vector<std::string>> rows;
};

std::string as_text(const Table& table);      ///< aligned columns
std::string as_csv(const Table& table);       ///< RFC 4180, with "\n"
std::string as_markdown(const Table& table);  ///< a GitHub table

}  // namespace atrium
