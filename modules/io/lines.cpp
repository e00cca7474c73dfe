#include "modules/io/lines.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <limits>

namespace atrium::io {
namespace {

constexpr std::size_t piece_size = std::size_t{1} << 20U;

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

bool is_row(std::string_view line, bool comments) {
  std::size_t i = 0;
  while (i < line.size() && is_space(line[i])) ++i;
  if (i == line.size()) return false;
  return !comments || !(line[i] == '#' || (line[i] == '/' && i + 1 < line.size() && line[i + 1] == '/'));
}

std::vector<Lines::Piece> cut(std::string_view text) {
  std::vector<Lines::Piece> pieces;
  while (!text.empty()) {
    std::size_t length = std::min(text.size(), piece_size);
    const std::size_t end = text.find_first_of("\r\n", length - 1);
    length = end == std::string_view::npos ? text.size() : end + 1;
    if (length < text.size() && text[length - 1] == '\r' && text[length] == '\n') ++length;
    pieces.push_back({text.substr(0, length)});
    text.remove_prefix(length);
  }
  return pieces;
}

}  // namespace

std::string_view without_mark(std::string_view text) {
  return text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

Lines::Lines(std::string_view text, std::size_t first_line, bool comments, const Context& context,
             const MappedFile* file)
    : comments_(comments), pieces_(cut(text)) {
  std::vector<std::size_t> lines(pieces_.size());
  context.parallel_for(
      pieces_.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          for_lines(pieces_[i].text, [&](std::string_view line) {
            ++lines[i];
            pieces_[i].rows += is_row(line, comments_) ? 1 : 0;
            return true;
          });
          constexpr std::size_t some_pieces = 64;
          if (file != nullptr && i % some_pieces == 0) file->drop_pages();
        }
      },
      1);
  std::size_t row = 0;
  std::size_t line = first_line;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    pieces_[i].first_row = row;
    pieces_[i].first_line = line;
    row += pieces_[i].rows;
    line += lines[i];
  }
  end_line_ = line - 1;
}

void Lines::for_rows(std::size_t begin, std::size_t end, const Context& context,
                     const std::function<void(std::size_t, const Row&)>& work) const {
  std::vector<std::exception_ptr> errors(pieces_.size());
  context.parallel_for(
      pieces_.size(),
      [&](std::size_t first, std::size_t last) {
        for (std::size_t p = first; p < last; ++p) {
          try {
            rows_of(p, begin, end, [&](const Row& row) { work(p, row); });
          } catch (...) {
            errors[p] = std::current_exception();
          }
        }
      },
      1);
  for (const auto& error : errors)
    if (error) std::rethrow_exception(error);
}

void Lines::rows_of(std::size_t p, std::size_t begin, std::size_t end,
                    const std::function<void(const Row&)>& work) const {
  const Piece& piece = pieces_[p];
  if (piece.first_row + piece.rows <= begin || piece.first_row >= end) return;
  Row row{piece.first_row, piece.first_line, {}};
  for_lines(piece.text, [&](std::string_view line) {
    if (is_row(line, comments_)) {
      row.text = line;
      if (row.index >= begin) work(row);
      ++row.index;
    }
    ++row.line;
    return row.index < end;
  });
}

Row Lines::row(std::size_t index) const {
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), index, [](std::size_t i, const Piece& piece) {
    return i < piece.first_row + piece.rows;
  });
  Row found;
  rows_of(static_cast<std::size_t>(after - pieces_.begin()), index, index + 1, [&](const Row& row) { found = row; });
  return found;
}

std::string_view next_token(std::string_view& text, Commas commas) {
  const auto is_separator = [&](char c) {
    return is_space(c) || (commas == Commas::separate && (c == ',' || c == ';'));
  };
  std::size_t begin = 0;
  while (begin < text.size() && is_separator(text[begin])) ++begin;
  std::size_t end = begin;
  while (end < text.size() && !is_separator(text[end])) ++end;
  const std::string_view token = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return token;
}

bool parse_number(std::string_view token, double& value) {
  if (token.starts_with('+')) token.remove_prefix(1);
  const char* end = token.data() + token.size();
  const auto [stop, error] = std::from_chars(token.data(), end, value);
  if (error == std::errc::result_out_of_range && stop == end) {
    value = std::strtod(std::string(token).c_str(), nullptr);  // ±inf, or 0 when too small
    return true;
  }
  if (error != std::errc{}) return false;
  if (stop == end) return true;
  // Old Windows programs write what is not finite as "1.#QNAN", "-1.#IND", "1.#INF".
  constexpr std::string_view words[] = {"#qnan", "#snan", "#ind", "#inf"};
  const std::string word = lower_case(std::string_view(stop, static_cast<std::size_t>(end - stop)));
  if (token.size() > 16 ||
      std::none_of(std::begin(words), std::end(words), [&](auto known) { return word.starts_with(known); }))
    return false;
  value = std::numeric_limits<double>::quiet_NaN();
  return true;
}

std::string no_number(std::string_view token) {
  const bool comma = std::count(token.begin(), token.end(), ',') == 1;
  return quote(token) + " is not a number" + (comma ? " (decimals follow a point, as in 1.5)" : "");
}

std::string quote(std::string_view text) {
  std::string result = "'";
  for (const char c : text.substr(0, 40)) result += c >= ' ' && c != '\x7f' ? c : '?';
  return result + (text.size() > 40 ? "…'" : "'");
}

}  // namespace atrium::io
