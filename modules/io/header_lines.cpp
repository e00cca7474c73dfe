#include "modules/io/header_lines.hpp"

#include <fmt/format.h>

#include <charconv>

#include "graph/api/error.hpp"
#include "modules/io/lines.hpp"

namespace atrium::io {

HeaderLines::HeaderLines(const MappedFile& file, std::string missing)
    : file_(file), missing_(std::move(missing)), position_(file.size() - without_mark(file.text()).size()) {}

std::string_view HeaderLines::next() {
  const std::string_view rest = file_.text().substr(position_);
  const std::size_t length = rest.find_first_of("\r\n");
  ++count_;
  if (length == std::string_view::npos) fail(missing_);
  const bool returned = rest[length] == '\r';
  const bool both = returned && !only_returns_ && rest.substr(length + 1).starts_with('\n');
  only_returns_ = returned && !both && (count_ == 1 || only_returns_);
  position_ += length + (both ? 2 : 1);
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
