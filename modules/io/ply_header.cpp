#include "modules/io/ply_header.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <utility>

#include "graph/api/error.hpp"
#include "modules/io/header_lines.hpp"
#include "modules/io/lines.hpp"

namespace atrium::io {
namespace {

constexpr std::pair<std::string_view, Scalar> type_names[] = {
    {"char", Scalar::i8},    {"int8", Scalar::i8},    {"uchar", Scalar::u8},   {"uint8", Scalar::u8},
    {"short", Scalar::i16},  {"int16", Scalar::i16},  {"ushort", Scalar::u16}, {"uint16", Scalar::u16},
    {"int", Scalar::i32},    {"int32", Scalar::i32},  {"uint", Scalar::u32},   {"uint32", Scalar::u32},
    {"int64", Scalar::i64},  {"uint64", Scalar::u64}, {"float", Scalar::f32},  {"float32", Scalar::f32},
    {"double", Scalar::f64}, {"float64", Scalar::f64}};

/// Reads the header line by line.
class PlyHeaderParser {
 public:
  explicit PlyHeaderParser(const MappedFile& file) : lines_(file, "the header ends without 'end_header' (truncated?)") {
    if (!begins_as_ply(file.text())) throw Error(file.path() + ": not a PLY file: its first line is not 'ply'");
  }

  PlyHeader parse() {
    bool has_format = false;
    lines_.next();
    for (;;) {
      std::string_view line = lines_.next();
      const std::string keyword = lower_case(next_token(line));
      if (keyword == "end_header") break;
      if (keyword == "comment" || keyword == "obj_info" || keyword.empty()) continue;
      if (keyword == "format")
        has_format = read_format(line);
      else if (keyword == "element")
        read_element(line);
      else if (keyword == "property")
        read_property(line);
      else
        lines_.fail("unknown keyword " + quote(keyword));
    }
    if (!has_format) lines_.fail("the header has no line 'format'");
    header_.body = lines_.position();
    header_.lines = lines_.count();
    return std::move(header_);
  }

 private:
  bool read_format(std::string_view line) {
    const std::string name = lower_case(next_token(line));
    if (name == "ascii")
      header_.format = PlyHeader::Format::ascii;
    else if (name == "binary_little_endian")
      header_.format = PlyHeader::Format::little_endian;
    else if (name == "binary_big_endian")
      header_.format = PlyHeader::Format::big_endian;
    else
      lines_.fail("unknown format " + quote(name) + "; known: ascii, binary_little_endian, binary_big_endian");
    return true;
  }

  void read_element(std::string_view line) {
    PlyElement element;
    element.name = lower_case(next_token(line));
    const std::string_view count = next_token(line);
    const auto [stop, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (element.name.empty() || error != std::errc{} || stop != count.data() + count.size())
      lines_.fail("an element needs a name and a count: 'element vertex 1000', not " + quote(count) + " as count");
    for (const auto& other : header_.elements)
      if (other.name == element.name) lines_.fail("the element " + quote(element.name) + " is declared twice");
    header_.elements.push_back(std::move(element));
  }

  Scalar read_type(std::string_view& line) {
    const std::string name = lower_case(next_token(line));
    for (const auto& [known, type] : type_names)
      if (known == name) return type;
    lines_.fail("unknown property type " + quote(name));
  }

  void read_property(std::string_view line) {
    if (header_.elements.empty()) lines_.fail("a property before the first element");
    PlyProperty property;
    std::string_view ahead = line;
    if (lower_case(next_token(ahead)) == "list") {
      line = ahead;
      property.count_type = read_type(line);
      if (is_floating(property.count_type)) lines_.fail("the length of a list cannot be a floating-point number");
    }
    property.type = read_type(line);
    property.name = lower_case(next_token(line));
    if (property.name.empty()) lines_.fail("a property without a name");
    header_.elements.back().properties.push_back(std::move(property));
  }

  HeaderLines lines_;
  PlyHeader header_;
};

}  // namespace

std::size_t PlyElement::record_size() const {
  std::size_t size = 0;
  for (const auto& p : properties) size += size_of(p.is_list() ? p.count_type : p.type);
  return size;
}

bool PlyElement::has_lists() const {
  for (const auto& p : properties)
    if (p.is_list()) return true;
  return false;
}

bool begins_as_ply(std::string_view text) {
  constexpr std::size_t longest = 80;
  text = without_mark(text).substr(0, longest);
  std::string_view line = text.substr(0, text.find_first_of("\r\n"));
  return lower_case(next_token(line)) == "ply" && next_token(line).empty();
}

PlyHeader read_ply_header(const MappedFile& file) { return PlyHeaderParser(file).parse(); }

}  // namespace atrium::io
