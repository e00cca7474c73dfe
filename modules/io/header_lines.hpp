#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "graph/api/mapped_file.hpp"

namespace atrium::io {

/// Walks the lines of a text header before binary data, and names the line in errors.
class HeaderLines {
 public:
  /// `missing`: what the Error says if the file ends before the header does. A byte order mark is passed over.
  HeaderLines(const MappedFile& file, std::string missing);

  /// The next line without its end, which is LF, CR LF or CR. Where all ends before were CR alone, an LF behind one
  /// more belongs to the data.
  std::string_view next();
  std::size_t position() const { return position_; }  ///< byte behind the last line
  std::size_t count() const { return count_; }        ///< lines read so far
  /// Throws Error: path, line, what.
  [[noreturn]] void fail(const std::string& what) const;
  /// The token as a whole number; fails if it is none.
  std::uint64_t whole(std::string_view token) const;

 private:
  const MappedFile& file_;
  std::string missing_;
  std::size_t position_ = 0, count_ = 0;
  bool only_returns_ = false;  ///< all lines so far end with CR alone
};

}  // namespace atrium::io
