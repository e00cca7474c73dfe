#include "modules/building/step_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "graph/api/error.hpp"

namespace atrium::building {
namespace {

bool digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool hex_digit(char c) { return digit(c) || (c >= 'A' && c <= 'F'); }
bool word(char c) { return digit(c) || (c >= 'A' && c <= 'Z') || c == '_'; }

class StepParser {
 public:
  explicit StepParser(std::string_view text) : text_(text) {}

  StepInstances run() {
    expect("ISO-10303-21;");
    expect("HEADER;");
    while (!begins("ENDSEC;")) header_line();
    expect("ENDSEC;");
    expect("DATA;");
    while (!begins("ENDSEC;")) instance();
    expect("ENDSEC;");
    expect("END-ISO-10303-21;");
    if (at_ != text_.size()) fail("something follows the end of the file");
    return std::move(instances_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
    throw Error(fmt::format("line {} of the STEP file: {}", line, what));
  }
  void skip() {
    while (at_ < text_.size() && (text_[at_] == '\n' || text_[at_] == ' ' || text_[at_] == '\r')) ++at_;
  }
  bool begins(std::string_view what) {
    skip();
    if (at_ >= text_.size()) fail("the file ends too early");
    return text_.substr(at_).starts_with(what);
  }
  void expect(std::string_view what) {
    if (!begins(what)) fail(fmt::format("'{}' is expected", what));
    at_ += what.size();
    skip();
  }
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  std::string name() {
    const std::size_t from = at_;
    while (word(peek())) ++at_;
    if (at_ == from) fail("a type's name is expected");
    return std::string(text_.substr(from, at_ - from));
  }
  std::uint32_t number() {
    expect("#");
    std::uint32_t id = 0;
    if (!digit(peek())) fail("an instance's number is expected");
    for (; digit(peek()); ++at_) {
      if (id > 400000000) fail("an instance's number is too large");
      id = id * 10 + static_cast<std::uint32_t>(peek() - '0');
    }
    return id;
  }
  void header_line() {
    name();
    fields();
    expect(";");
  }
  void instance() {
    const std::size_t begin = at_;
    const std::uint32_t id = number();
    expect("=");
    StepInstance own{name(), {}};
    own.fields = fields();
    expect(";");
    if (instances_.try_emplace(id, std::move(own)).second) return;
    at_ = begin;
    fail(fmt::format("#{} is there twice", id));
  }
  std::vector<std::string> fields() {
    std::vector<std::string> result;
    if (++depth_ > 50) fail("lists within lists too deep");
    expect("(");
    while (peek() != ')') {
      const std::size_t from = at_;
      field();
      result.emplace_back(text_.substr(from, at_ - from));
      skip();
      if (peek() == ',')
        expect(",");
      else if (peek() != ')')
        fail("',' or ')' is expected");
    }
    ++at_;
    --depth_;
    return result;
  }
  void field() {
    const char c = peek();
    if (c == '$' || c == '*')
      ++at_;
    else if (c == '#')
      number();
    else if (c == '\'')
      string();
    else if (c == '(')
      fields();
    else if (c == '.')
      enumeration();
    else if (digit(c) || c == '-')
      value();
    else {
      name();
      fields();
    }
  }
  void enumeration() {
    ++at_;
    name();
    if (peek() != '.') fail("'.' is expected");
    ++at_;
  }
  void value() {
    if (peek() == '-') ++at_;
    if (!digit(peek())) fail("a digit is expected");
    while (digit(peek())) ++at_;
    if (peek() == '.') {
      ++at_;
      while (digit(peek())) ++at_;
      if (peek() == 'E') {
        ++at_;
        if (peek() == '-' || peek() == '+') ++at_;
        if (!digit(peek())) fail("an exponent is expected");
        while (digit(peek())) ++at_;
      }
    }
  }
  void string() {
    for (++at_;; ++at_) {
      const char c = peek();
      if (c < 0x20 || c > 0x7E) fail("a string holds what is not printable ASCII");
      if (c == '\\') escape();
      if (c != '\'') continue;
      if (at_ + 1 >= text_.size() || text_[at_ + 1] != '\'') break;
      ++at_;
    }
    ++at_;
  }
  /// Ends on the escape's last character.
  void escape() {
    const std::string_view rest = text_.substr(at_);
    if (rest.starts_with("\\\\")) {
      ++at_;
      return;
    }
    if (!rest.starts_with("\\X2\\") && !rest.starts_with("\\X4\\")) fail("an escape that is none");
    const std::size_t unit = rest[2] == '2' ? 4 : 8;
    std::size_t digits = 4;
    while (digits < rest.size() && hex_digit(rest[digits])) ++digits;
    if (digits == 4 || (digits - 4) % unit != 0 || !rest.substr(digits).starts_with("\\X0\\"))
      fail("an escape that is none");
    at_ += digits + 3;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
  StepInstances instances_;
};

/// How many fields the types have that are written, after IFC4 ADD2 TC1.
const std::map<std::string_view, std::size_t>& field_counts() {
  static const std::map<std::string_view, std::size_t> table{{"IFCGEOMETRICREPRESENTATIONCONTEXT", 6},
                                                             {"IFCGEOMETRICREPRESENTATIONSUBCONTEXT", 10},
                                                             {"IFCCARTESIANPOINT", 1},
                                                             {"IFCDIRECTION", 1},
                                                             {"IFCAXIS2PLACEMENT3D", 3},
                                                             {"IFCLOCALPLACEMENT", 2},
                                                             {"IFCPOLYLINE", 1},
                                                             {"IFCARBITRARYCLOSEDPROFILEDEF", 3},
                                                             {"IFCARBITRARYPROFILEDEFWITHVOIDS", 4},
                                                             {"IFCEXTRUDEDAREASOLID", 4},
                                                             {"IFCINDEXEDPOLYGONALFACE", 1},
                                                             {"IFCINDEXEDPOLYGONALFACEWITHVOIDS", 2},
                                                             {"IFCCARTESIANPOINTLIST3D", 1},
                                                             {"IFCPOLYGONALFACESET", 4},
                                                             {"IFCTRIANGULATEDFACESET", 5},
                                                             {"IFCSHAPEREPRESENTATION", 4},
                                                             {"IFCPRODUCTDEFINITIONSHAPE", 3},
                                                             {"IFCCOLOURRGB", 4},
                                                             {"IFCSURFACESTYLERENDERING", 9},
                                                             {"IFCSURFACESTYLE", 3},
                                                             {"IFCSTYLEDITEM", 3},
                                                             {"IFCSIUNIT", 4},
                                                             {"IFCUNITASSIGNMENT", 1},
                                                             {"IFCPROJECT", 9},
                                                             {"IFCPROJECTEDCRS", 7},
                                                             {"IFCMAPCONVERSION", 8},
                                                             {"IFCSITE", 14},
                                                             {"IFCBUILDING", 12},
                                                             {"IFCBUILDINGSTOREY", 10},
                                                             {"IFCSPACE", 11},
                                                             {"IFCWALL", 9},
                                                             {"IFCSLAB", 9},
                                                             {"IFCCOLUMN", 9},
                                                             {"IFCOPENINGELEMENT", 9},
                                                             {"IFCDOOR", 13},
                                                             {"IFCWINDOW", 13},
                                                             {"IFCBUILDINGELEMENTPROXY", 9},
                                                             {"IFCRELAGGREGATES", 6},
                                                             {"IFCRELCONTAINEDINSPATIALSTRUCTURE", 6},
                                                             {"IFCRELVOIDSELEMENT", 6},
                                                             {"IFCRELFILLSELEMENT", 6},
                                                             {"IFCRELDEFINESBYPROPERTIES", 6},
                                                             {"IFCRELASSOCIATESMATERIAL", 6},
                                                             {"IFCRELSPACEBOUNDARY", 9},
                                                             {"IFCMATERIAL", 3},
                                                             {"IFCPROPERTYSET", 5},
                                                             {"IFCPROPERTYSINGLEVALUE", 4},
                                                             {"IFCELEMENTQUANTITY", 6},
                                                             {"IFCQUANTITYLENGTH", 5},
                                                             {"IFCQUANTITYAREA", 5},
                                                             {"IFCQUANTITYVOLUME", 5},
                                                             {"IFCPLANE", 1},
                                                             {"IFCCURVEBOUNDEDPLANE", 3},
                                                             {"IFCCONNECTIONSURFACEGEOMETRY", 2}};
  return table;
}

bool has_global_id(std::string_view type) {
  static const std::set<std::string_view> plain{"IFCPROJECT",
                                                "IFCSITE",
                                                "IFCBUILDING",
                                                "IFCBUILDINGSTOREY",
                                                "IFCSPACE",
                                                "IFCWALL",
                                                "IFCSLAB",
                                                "IFCCOLUMN",
                                                "IFCDOOR",
                                                "IFCWINDOW",
                                                "IFCOPENINGELEMENT",
                                                "IFCPROPERTYSET",
                                                "IFCELEMENTQUANTITY",
                                                "IFCBUILDINGELEMENTPROXY"};
  return plain.contains(type) || type.starts_with("IFCREL");
}

void append_utf8(std::string& out, unsigned long c) {
  const auto byte = [&](unsigned long v) { out += static_cast<char>(v); };
  if (c < 0x80) {
    byte(c);
  } else if (c < 0x800) {
    byte(0xC0U | c >> 6U);
    byte(0x80U | (c & 0x3FU));
  } else if (c < 0x10000) {
    byte(0xE0U | c >> 12U);
    byte(0x80U | (c >> 6U & 0x3FU));
    byte(0x80U | (c & 0x3FU));
  } else {
    byte(0xF0U | c >> 18U);
    byte(0x80U | (c >> 12U & 0x3FU));
    byte(0x80U | (c >> 6U & 0x3FU));
    byte(0x80U | (c & 0x3FU));
  }
}

}  // namespace

StepInstances read_step(std::string_view text) { return StepParser(text).run(); }

std::vector<std::uint32_t> refs_of(std::string_view field) {
  std::vector<std::uint32_t> result;
  bool quoted = false;
  for (std::size_t i = 0; i < field.size(); ++i) {
    if (field[i] == '\'') quoted = !quoted;
    if (quoted || field[i] != '#') continue;
    std::uint32_t id = 0;
    for (++i; i < field.size() && digit(field[i]); ++i) id = id * 10 + static_cast<std::uint32_t>(field[i] - '0');
    --i;
    result.push_back(id);
  }
  return result;
}

std::string text_of(std::string_view field) {
  std::string result;
  for (std::size_t i = 1; i + 1 < field.size(); ++i) {
    const std::string_view rest = field.substr(i);
    if (rest.starts_with("\\X2\\") || rest.starts_with("\\X4\\")) {
      const std::size_t unit = rest[2] == '2' ? 4 : 8;
      for (i += 4; hex_digit(field[i]); i += unit)
        append_utf8(result, std::stoul(std::string(field.substr(i, unit)), nullptr, 16));
      i += 3;
      continue;
    }
    if (field[i] == '\\' || field[i] == '\'') ++i;
    result += field[i];
  }
  return result;
}

void check_ifc(const StepInstances& instances) {
  constexpr std::string_view digits = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_$";
  std::set<std::string> ids;
  for (const auto& [id, instance] : instances) {
    const auto fail = [&, number = id, &type = instance.type](const std::string& what) {
      throw Error(fmt::format("#{}, {}: {}", number, type, what));
    };
    const auto count = field_counts().find(instance.type);
    if (count == field_counts().end()) fail("a type that is not written");
    if (instance.fields.size() != count->second)
      fail(fmt::format("{} fields, not {}", instance.fields.size(), count->second));
    for (const auto& field : instance.fields)
      for (const auto ref : refs_of(field))
        if (!instances.contains(ref)) fail(fmt::format("#{} is not there", ref));
    if (!has_global_id(instance.type)) continue;
    const std::string own = text_of(instance.fields[0]);
    if (own.size() != 22 || own[0] > '3' || own.find_first_not_of(digits) != std::string::npos)
      fail(fmt::format("'{}' is no GlobalId", own));
    if (!ids.insert(own).second) fail(fmt::format("the GlobalId '{}' is another's too", own));
  }
}

}  // namespace atrium::building
