#include "modules/io/header_lines.hpp"

#include <fmt/format.h>

#include <charconv>

#include "graph/api/error.hpp"
#include "modules/io/lines.hpp"

namespace atrium::io {

std::string_view HeaderLines::next() {
  const std::string_view rest = file_.text().substr(position_);
  const std::size_t length = rest.find(line_end_);
  ++count_;
  if (length == std::string_view::npos) fail(missing_);
  position_ += length + line_end_.size();
  return rest.substr(0, length);
}

void HeaderLines::fail(const std::string& what) const {
  throw Error(fmt::format("{}:{}: {}", file_.path(), count_, what));
}

std::uint64_t HeaderLines::whole(std::string_view token) const {
  std::uint64_t value = 0;
  const auto [stop, error] = std::from_chars(token.data(), token.data() + token.size(), value);
  if (error != std::errc{} || stop != token.data() + token.size() || token.empty())
    fail(quote(token) + " is not a whole number");
  return value;
}

}  // namespace atrium::io
