#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace atrium::io {

/// Takes the numbers of a text whose records are not one a line: one number a line, lines broken at some width, several
/// records a line. Gives them back as one record a line.
class FreeNumbers {
 public:
  explicit FreeNumbers(std::string_view text) : rest_(text) {}

  /// Takes the next number. False where there is none, or something else.
  bool take(double& value);
  void end_record();
  /// One record a line, if nothing is left and the lines make sense: every record begins on a new line, or no record
  /// goes over a line's end. Else a number too few here and one too many there could be taken for a layout: nothing.
  std::optional<std::string> text();

 private:
  std::string_view rest_;
  std::string text_;
  bool in_record_ = false, begins_within_ = false, broken_ = false;
};

}  // namespace atrium::io
