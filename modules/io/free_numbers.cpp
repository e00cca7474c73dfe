#include "modules/io/free_numbers.hpp"

#include <algorithm>

#include "modules/io/lines.hpp"

namespace atrium::io {

bool FreeNumbers::take(double& value) {
  bool new_line = text_.empty();
  while (!rest_.empty() &&
         (rest_.front() == '\n' || rest_.front() == '\r' || rest_.front() == ' ' || rest_.front() == '\t')) {
    new_line = new_line || rest_.front() == '\n' || rest_.front() == '\r';
    rest_.remove_prefix(1);
  }
  const std::size_t length = std::min(rest_.find_first_of("\n\r \t"), rest_.size());
  const std::string_view token = rest_.substr(0, length);
  if (token.empty() || !parse_number(token, value)) return false;
  rest_.remove_prefix(length);
  if (in_record_ && new_line) broken_ = true;
  if (!in_record_ && !new_line) begins_within_ = true;
  in_record_ = true;
  text_ += token;
  text_ += ' ';
  return true;
}

void FreeNumbers::end_record() {
  in_record_ = false;
  if (!text_.empty()) text_.back() = '\n';
}

std::optional<std::string> FreeNumbers::text() {
  if (rest_.find_first_not_of("\n\r \t") != std::string_view::npos || (begins_within_ && broken_)) return std::nullopt;
  return std::move(text_);
}

}  // namespace atrium::io
