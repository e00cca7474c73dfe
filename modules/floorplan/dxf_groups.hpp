#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>

namespace atrium::floorplan {

/// Number by which the parts of a DXF file name each other; none has 0.
using DxfHandle = std::uint32_t;

/// Text as DXF 2000 has it: in the code page Windows-1252 ($DWGCODEPAGE ANSI_1252), with \U+XXXX for other characters.
/// Control characters are left out, and what \U+XXXX cannot say (broken UTF-8, characters beyond U+FFFF) becomes a
/// question mark.
std::string dxf_text(std::string_view utf8);

/// The pairs of group code and value that a DXF file consists of, one after the other.
class DxfGroups {
 public:
  /// Without line breaks; what may hold other characters than ASCII goes through dxf_text first.
  void text(int code, std::string_view value);
  void integer(int code, std::int64_t value);
  /// All digits of a double, without an exponent. Throws Error if it is not finite.
  void real(int code, double value);
  void handle(int code, DxfHandle value);
  /// Groups code and code + 10.
  void point(int code, const Eigen::Vector2d& p);
  /// The same and code + 20.
  void point(int code, const Eigen::Vector2d& p, double z);
  /// Begins a table's row, a block, an entity or an object: its kind, its handle and that of its owner.
  void record(std::string_view kind, DxfHandle handle, DxfHandle owner);
  /// Begins the groups of a class that a record belongs to.
  void subclass(std::string_view name) { text(100, name); }
  void begin_section(std::string_view name);
  void end_section() { text(0, "ENDSEC"); }

  void append(const DxfGroups& more) { text_ += more.text_; }
  const std::string& all() const { return text_; }

 private:
  std::string text_;
};

}  // namespace atrium::floorplan
