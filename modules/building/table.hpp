#pragma once
#include <fmt/format.h>

#include <string>

namespace atrium::building {

/// Lines of a CSV file (RFC 4180). Numbers to a thousandth.
class CsvTable {
 public:
  explicit CsvTable(const std::string& columns) : text_(columns + "\r\n") {}
  CsvTable& operator<<(const std::string& value) {
    if (!first_) text_ += ',';
    first_ = false;
    if (value.find_first_of(",\"\r\n") == std::string::npos) {
      text_ += value;
      return *this;
    }
    text_ += '"';
    for (const char c : value) text_ += c == '"' ? "\"\"" : std::string(1, c);
    text_ += '"';
    return *this;
  }
  CsvTable& operator<<(double value) {
    const std::string text = fmt::format("{:.3f}", value);
    return *this << (text == "-0.000" ? std::string("0.000") : text);
  }
  CsvTable& operator<<(std::size_t value) { return *this << std::to_string(value); }
  void end() {
    text_ += "\r\n";
    first_ = true;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  bool first_ = true;
};

}  // namespace atrium::building
