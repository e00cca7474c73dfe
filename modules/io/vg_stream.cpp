#include "modules/io/vg_stream.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>

#include "graph/api/error.hpp"
#include "modules/io/lines.hpp"
#include "modules/io/scalar.hpp"

namespace atrium::io {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f'; }

class TextStream final : public VgStream {
 public:
  explicit TextStream(const MappedFile& file) : path_(file.path()), text_(without_mark(file.text())) {}

  std::uint64_t count(std::string_view what, std::size_t numbers) override {
    name(what);
    const std::int64_t value = index(what);
    // Each number takes a digit and a blank at least.
    const std::size_t left = (text_.size() - place_ + 1) / 2;
    if (value < 0) fail(fmt::format("{} is {}", what, value));
    if (static_cast<std::uint64_t>(value) > left / std::max<std::size_t>(numbers, 1))
      fail(fmt::format("{} is {}, more than the {} bytes that are left can hold (truncated?)", what, value,
                       text_.size() - place_));
    return static_cast<std::uint64_t>(value);
  }
  std::int64_t index(std::string_view what) override {
    const std::string_view t = token(what);
    std::int64_t value = 0;
    const auto [stop, error] = std::from_chars(t.data(), t.data() + t.size(), value);
    if (error != std::errc{} || stop != t.data() + t.size())
      fail(fmt::format("{} is not a whole number ({})", quote(t), what));
    return value;
  }
  double number(std::string_view what) override {
    const std::string_view t = token(what);
    double value = 0;
    if (!parse_number(t, value)) fail(fmt::format("{} ({})", no_number(t), what));
    return value;
  }
  void name(std::string_view what) override {
    const std::string_view t = token(what);
    const std::size_t colon = t.find(':');
    if (!is_called(t.substr(0, colon), what))
      fail(fmt::format("the name '{}:' is missing, there is {}", what, quote(t)));
    if (colon != std::string_view::npos) {
      place_ = last_ + colon + 1;
      return;
    }
    const std::size_t here = place_;
    if (place_ < text_.size() && token(what) != ":") place_ = here;
  }
  void label() override {
    name("group_label");
    const std::size_t here = place_;
    // An empty label: the next name follows at once.
    if (token("group_label").starts_with("group_color:")) place_ = here;
  }
  std::string where() const override {
    std::size_t line = 1;
    for (std::size_t i = 0; i < last_; ++i)
      if (text_[i] == '\n' || (text_[i] == '\r' && !text_.substr(i + 1).starts_with('\n'))) ++line;
    return fmt::format("{}:{}", path_, line);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw Error(where() + ": " + what); }

  /// Programs write num_group_points, group_num_point, normals …: prefixes, letter case, a plural and "colour" do not
  /// matter.
  static bool is_called(std::string_view name, std::string_view what) {
    const auto plain = [](std::string_view text) {
      std::string lower = lower_case(text);
      while (lower.starts_with("num_") || lower.starts_with("group_")) lower.erase(0, lower.find('_') + 1);
      if (lower.ends_with('s')) lower.pop_back();
      if (const std::size_t at = lower.find("colour"); at != std::string::npos) lower.erase(at + 4, 1);
      return lower;
    };
    return plain(name) == plain(what);
  }

  std::string_view token(std::string_view what) {
    while (place_ < text_.size() && is_blank(text_[place_])) ++place_;
    last_ = place_;
    while (place_ < text_.size() && !is_blank(text_[place_])) ++place_;
    if (place_ == last_) fail(fmt::format("truncated: the file ends where {} should be", what));
    return text_.substr(last_, place_ - last_);
  }

  std::string path_;
  std::string_view text_;
  std::size_t place_ = 0, last_ = 0;
};

class BinaryStream final : public VgStream {
 public:
  explicit BinaryStream(const MappedFile& file) : file_(file) {}

  std::uint64_t count(std::string_view what, std::size_t numbers) override {
    const std::int64_t value = index(what);
    const std::size_t left = file_.size() - place_;
    if (value < 0) throw Error(fmt::format("{}: {} is {}", where(), what, value));
    if (static_cast<std::uint64_t>(value) > left / (4 * std::max<std::size_t>(numbers, 1)))
      throw Error(fmt::format("{}: {} is {}, more than the {} bytes that are left can hold (truncated?)", where(), what,
                              value, left));
    return static_cast<std::uint64_t>(value);
  }
  std::int64_t index(std::string_view what) override { return take<std::int32_t>(what); }
  double number(std::string_view what) override { return take<float>(what); }
  void name(std::string_view /*what*/) override {}
  void label() override {
    const std::int64_t length = index("the length of group_label");
    if (length < 0 || static_cast<std::uint64_t>(length) > file_.size() - place_)
      throw Error(
          fmt::format("{}: a group_label of {} bytes, but {} are left", where(), length, file_.size() - place_));
    place_ += static_cast<std::size_t>(length);
  }
  std::string where() const override { return fmt::format("{}: byte {}", file_.path(), last_); }

 private:
  template <class T>
  T take(std::string_view what) {
    last_ = place_;
    if (file_.size() - place_ < sizeof(T))
      throw Error(fmt::format("{}: truncated: the file ends where {} should be", where(), what));
    const T value = load<T>(file_.data() + place_, std::endian::native == std::endian::big);
    place_ += sizeof(T);
    return value;
  }

  const MappedFile& file_;
  std::size_t place_ = 0, last_ = 0;
};

}  // namespace

std::unique_ptr<VgStream> vg_text_stream(const MappedFile& file) { return std::make_unique<TextStream>(file); }
std::unique_ptr<VgStream> vg_binary_stream(const MappedFile& file) { return std::make_unique<BinaryStream>(file); }

}  // namespace atrium::io
