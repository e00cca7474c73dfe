#include "modules/io/stl_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <unordered_map>

#include "graph/api/error.hpp"
#include "graph/api/text.hpp"
#include "modules/io/lines.hpp"

namespace atrium::io {
namespace {

using Corner = std::array<double, 3>;

struct CornerHash {
  std::size_t operator()(const Corner& c) const {
    std::uint64_t h = 0;
    for (const double v : c) h = mix_seed(h, std::bit_cast<std::uint64_t>(v));
    return h;
  }
};

/// Joins equal corners to vertices, numbered by their first use.
class Welder {
 public:
  std::uint32_t add(Corner corner) {
    for (double& v : corner) v += 0.0;  // -0 is 0
    const auto [place, is_new] = known_.try_emplace(corner, static_cast<std::uint32_t>(vertices_.size()));
    if (is_new) vertices_.push_back(corner);
    return place->second;
  }
  void finish(RawGeometry& geometry) const {
    auto table = std::make_shared<Table>(vertices_.size(), std::vector<Role>{Role::x, Role::y, Role::z});
    for (std::size_t i = 0; i < vertices_.size(); ++i)
      for (std::size_t a = 0; a < 3; ++a) table->row(i)[a] = vertices_[i][a];
    geometry.count = vertices_.size();
    if (geometry.count > 0) Table::attach(std::move(table), geometry);
  }

 private:
  std::unordered_map<Corner, std::uint32_t, CornerHash> known_;  // NaN corners stay apart: NaN is not NaN
  std::vector<Corner> vertices_;
};

constexpr bool stl_swapped = std::endian::native == std::endian::big;
constexpr std::size_t binary_head = 84;
constexpr std::size_t binary_facet = 50;

/// The number of facets as it is declared; where none are, as programs that write to a pipe leave it, as there is room
/// for.
std::uint64_t facets_of(const MappedFile& file, const Context& context) {
  const std::uint64_t declared = load<std::uint32_t>(file.data() + 80, stl_swapped);
  const std::uint64_t room = (file.size() - binary_head) / binary_facet;
  const bool whole = room > 0 && binary_head + room * binary_facet == file.size();
  if (whole && (declared == 0 || declared == 0xFFFFFFFF)) {
    context.warn(fmt::format("{}: {} facets are declared, but {} follow: all are read", file.path(), declared, room));
    return room;
  }
  if (declared > room)
    throw Error(fmt::format("{}: truncated: {} facets of 50 bytes are to follow byte 84, but the file has {} bytes",
                            file.path(), declared, file.size()),
                "the header promises more than the file holds: copy or export it again");
  if (declared < room)
    context.warn(fmt::format("{}: {} declared, and {} bytes more follow: these are not read", file.path(),
                             counted(declared, "facet is", "facets are"),
                             file.size() - binary_head - declared * binary_facet));
  return declared;
}

void read_binary(const MappedFile& file, RawGeometry& geometry, const Context& context) {
  if (file.size() < binary_head)
    throw Error(fmt::format("{}: truncated: an STL file has a head of 84 bytes, but the file has {} bytes", file.path(),
                            file.size()));
  const std::uint64_t facets = facets_of(file, context);
  geometry.float_table = true;
  Welder welder;
  geometry.triangles.reserve(facets);
  for (std::uint64_t f = 0; f < facets; ++f) {
    const std::byte* at = file.data() + binary_head + f * binary_facet + 12;  // after the facet's normal
    std::array<std::uint32_t, 3> triangle{};
    for (auto& vertex : triangle) {
      Corner corner{};
      for (double& v : corner) {
        v = load<float>(at, stl_swapped);
        at += sizeof(float);
      }
      vertex = welder.add(corner);
    }
    geometry.triangles.push_back(triangle);
  }
  welder.finish(geometry);
}

/// Text: the numbers after "vertex" count; each three of them, between "outer loop" and "endloop", are a facet. Upper
/// and lower case are the same, and a line may hold any part of it.
class TextParser {
 public:
  TextParser(const MappedFile& file, RawGeometry& geometry) : file_(file), geometry_(geometry) {}

  void read(const Context& context) {
    constexpr std::size_t often = 100000;  // lines
    for_lines(without_mark(file_.text()), [&](std::string_view text) {
      if (++line_ % often == 0) context.check_cancelled();
      read_line(text);
      return true;
    });
    if (in_loop_) fail("the file ends within a facet (truncated?)");
    if (!ended_) fail("the file ends without 'endsolid' (truncated?)");
    welder_.finish(geometry_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(fmt::format("{}:{}: {}", file_.path(), line_, what));
  }

  void read_line(std::string_view text) {
    for (auto token = next_token(text); !token.empty(); token = next_token(text)) {
      if (numbers_left_ > 0 && read_number(token)) continue;
      std::string keyword = lower_case(token);
      if (keyword == "end") keyword += lower_case(next_token(text));  // "end loop"
      if (keyword == "endsolid" || keyword == "solid") {              // its name follows
        ended_ = keyword == "endsolid";
        while (!text.empty() && !begins_with_facet(text)) next_token(text);
        continue;
      }
      read_keyword(keyword);
    }
  }

  static bool begins_with_facet(std::string_view text) {
    const std::string first = lower_case(next_token(text));
    return first == "facet" && lower_case(next_token(text)) == "normal";
  }

  /// A number of a normal, which is not looked at, or of a vertex. False if a normal ends early.
  bool read_number(std::string_view token) {
    if (!in_vertex_ && lower_case(token) == "outer") {
      numbers_left_ = 0;
      return false;
    }
    --numbers_left_;
    if (!in_vertex_) return true;
    if (!parse_number(token, corner_[2 - numbers_left_])) fail(no_number(token));
    if (numbers_left_ > 0) return true;
    corners_.push_back(welder_.add(corner_));
    in_vertex_ = false;
    return true;
  }

  void read_keyword(const std::string& keyword) {
    if (keyword == "vertex") {
      if (!in_loop_) fail("a vertex outside of 'outer loop' … 'endloop'");
      in_vertex_ = true;
      numbers_left_ = 3;
    } else if (keyword == "normal") {
      numbers_left_ = 3;
    } else if (keyword == "outer") {
      if (in_loop_) fail("'outer loop' before the 'endloop' of the last one");
      in_loop_ = true;
    } else if (keyword == "endloop") {
      if (!in_loop_ || corners_.size() != 3) fail("a facet of " + counted(corners_.size(), "vertex", "vertices"));
      geometry_.triangles.push_back({corners_[0], corners_[1], corners_[2]});
      corners_.clear();
      in_loop_ = false;
    } else if (keyword != "facet" && keyword != "endfacet" && keyword != "loop") {
      fail("unknown keyword " + quote(keyword));
    }
  }

  const MappedFile& file_;
  RawGeometry& geometry_;
  Welder welder_;
  std::vector<std::uint32_t> corners_;
  Corner corner_{};
  std::size_t numbers_left_ = 0, line_ = 0;
  bool in_loop_ = false, in_vertex_ = false, ended_ = false;
};

}  // namespace

bool begins_as_stl_text(std::string_view text) {
  constexpr std::size_t looked_at = 1024;
  text = without_mark(text).substr(0, looked_at);
  if (text.find('\0') != std::string_view::npos) return false;
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  return lower_case(text.substr(0, 5)) == "solid";
}

RawGeometry read_stl(const std::shared_ptr<const MappedFile>& file, const Context& context) {
  RawGeometry geometry;
  geometry.path = file->path();
  const bool exact =
      file->size() >= binary_head &&
      binary_head + binary_facet * std::uint64_t{load<std::uint32_t>(file->data() + 80, stl_swapped)} == file->size();
  if (!exact && begins_as_stl_text(file->text()))
    TextParser(*file, geometry).read(context);
  else
    read_binary(*file, geometry, context);
  return geometry;
}

}  // namespace atrium::io
