#pragma once
#include <cstddef>
#include <cstring>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "graph/api/context.hpp"
#include "graph/api/mapped_file.hpp"

namespace atrium::io {

/// Calls f(line), without its end, for each line of a text; f gives false to stop. A line ends with LF, CR LF or CR.
template <class F>
void for_lines(std::string_view text, F&& f) {
  const char* at = text.data();
  const char* const end = at + text.size();
  const char* feed = nullptr;  // the next LF, or the end
  const auto find = [](const char* from, char c, const char* to) {
    const void* found = from == to ? nullptr : std::memchr(from, c, static_cast<std::size_t>(to - from));
    return found == nullptr ? to : static_cast<const char*>(found);
  };
  while (at != end) {
    if (feed == nullptr || feed < at) feed = find(at, '\n', end);
    const char* const stop = find(at, '\r', feed);
    if (!f(std::string_view(at, static_cast<std::size_t>(stop - at)))) return;
    at = stop;
    if (at != end) at += *at == '\r' && at + 1 != end && at[1] == '\n' ? 2 : 1;
  }
}

/// The text without a byte order mark in front, as spreadsheets and editors write it.
std::string_view without_mark(std::string_view text);
/// ASCII letters in lower case.
std::string lower_case(std::string_view text);

/// A row: a line of a text file that is neither blank nor a comment.
struct Row {
  std::size_t index = 0;  ///< among rows
  std::size_t line = 0;   ///< 1-based, in the whole file
  std::string_view text;  ///< without the line's end
};

/// The rows of a text, cut at line ends into pieces of about a megabyte that are parsed side by side.
class Lines {
 public:
  struct Piece {
    std::string_view text;
    std::size_t first_row = 0, rows = 0;
    std::size_t first_line = 1;
  };

  /// `first_line`: number of the text's first line. comments: lines that begin with # or // are no rows. `file`: whose
  /// text it is; its pages are given back as they are counted.
  Lines(std::string_view text, std::size_t first_line, bool comments, const Context& context,
        const MappedFile* file = nullptr);

  std::size_t rows() const { return pieces_.empty() ? 0 : pieces_.back().first_row + pieces_.back().rows; }
  std::size_t end_line() const { return end_line_; }  ///< number of the last line
  const std::vector<Piece>& pieces() const { return pieces_; }

  /// Calls work(piece, row) for each row of [begin, end), pieces side by side, rows of a piece in order. Of several
  /// errors that of the earliest piece is thrown.
  void for_rows(std::size_t begin, std::size_t end, const Context& context,
                const std::function<void(std::size_t piece, const Row& row)>& work) const;
  /// Calls work(row) for the rows of one piece that lie in [begin, end), in order.
  void rows_of(std::size_t piece, std::size_t begin, std::size_t end,
               const std::function<void(const Row& row)>& work) const;
  /// One row.
  Row row(std::size_t index) const;

 private:
  bool comments_;
  std::size_t end_line_ = 0;
  std::vector<Piece> pieces_;
};

/// Takes the next token, delimited by blanks (and, if they separate, commas and semicolons); empty at the end.
enum class Commas : bool { belong, separate };
std::string_view next_token(std::string_view& text, Commas commas = Commas::belong);

/// Reads the whole token as a decimal number, "nan" and "inf" included. False if it is none.
bool parse_number(std::string_view token, double& value);
/// "'abc' is not a number", with what is meant probably.
std::string no_number(std::string_view token);

/// " 'abc'" shortened and with unprintable bytes replaced, for messages.
std::string quote(std::string_view text);

}  // namespace atrium::io
