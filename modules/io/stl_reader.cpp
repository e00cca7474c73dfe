#include "modules/io/stl_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <unordered_map>

#include "graph/api/error.hpp"
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

constexpr std::size_t binary_head = 84;
constexpr std::size_t binary_facet = 50;

void read_binary(const MappedFile& file, RawGeometry& geometry) {
  constexpr bool swapped = std::endian::native == std::endian::big;
  if (file.size() < binary_head)
    throw Error(fmt::format("{}: truncated: an STL file has a head of 84 bytes, but the file has {} bytes", file.path(),
                            file.size()));
  const std::uint64_t facets = load<std::uint32_t>(file.data() + 80, swapped);
  if (facets > (file.size() - binary_head) / binary_facet)
    throw Error(fmt::format("{}: truncated: {} facets of 50 bytes are to follow byte 84, but the file has {} bytes",
                            file.path(), facets, file.size()),
                "the header promises more than the file holds: copy or export it again");
  Welder welder;
  geometry.triangles.reserve(facets);
  for (std::uint64_t f = 0; f < facets; ++f) {
    const std::byte* at = file.data() + binary_head + f * binary_facet + 12;  // after the facet's normal
    std::array<std::uint32_t, 3> triangle{};
    for (auto& vertex : triangle) {
      Corner corner{};
      for (double& v : corner) {
        v = load<float>(at, swapped);
        at += sizeof(float);
      }
      vertex = welder.add(corner);
    }
    geometry.triangles.push_back(triangle);
  }
  welder.finish(geometry);
}

/// Text: only the lines "vertex x y z" count; each three of them, between "outer loop" and "endloop", are a facet.
class TextParser {
 public:
  TextParser(const MappedFile& file, RawGeometry& geometry) : file_(file), geometry_(geometry) {}

  void read(const Context& context) {
    const Lines lines(file_.text(), 1, false, context);
    for (const auto& piece : lines.pieces()) {
      std::size_t number = piece.first_line;
      for (std::string_view rest = piece.text; !rest.empty(); ++number) {
        const std::size_t length = std::min(rest.find('\n'), rest.size());
        line(rest.substr(0, length), number);
        rest.remove_prefix(std::min(rest.size(), length + 1));
      }
      context.check_cancelled();
    }
    if (in_loop_) fail(lines.end_line(), "the file ends within a facet (truncated?)");
    if (!ended_) fail(lines.end_line(), "the file ends without 'endsolid' (truncated?)");
    welder_.finish(geometry_);
  }

 private:
  [[noreturn]] void fail(std::size_t line, const std::string& what) const {
    throw Error(fmt::format("{}:{}: {}", file_.path(), line, what));
  }

  void line(std::string_view text, std::size_t number) {
    const std::string_view keyword = next_token(text);
    if (keyword == "vertex") {
      Corner corner{};
      for (double& v : corner) {
        const std::string_view token = next_token(text);
        if (!parse_number(token, v)) fail(number, quote(token) + " is not a number");
      }
      if (!in_loop_) fail(number, "a vertex outside of 'outer loop' … 'endloop'");
      corners_.push_back(welder_.add(corner));
    } else if (keyword == "outer") {
      if (in_loop_) fail(number, "'outer loop' before the 'endloop' of the last one");
      in_loop_ = true;
    } else if (keyword == "endloop") {
      if (!in_loop_ || corners_.size() != 3) fail(number, fmt::format("a facet of {} vertices", corners_.size()));
      geometry_.triangles.push_back({corners_[0], corners_[1], corners_[2]});
      corners_.clear();
      in_loop_ = false;
    } else if (keyword == "endsolid" || keyword == "solid") {
      ended_ = keyword == "endsolid";
    } else if (!keyword.empty() && keyword != "facet" && keyword != "endfacet") {
      fail(number, "unknown keyword " + quote(keyword));
    }
  }

  const MappedFile& file_;
  RawGeometry& geometry_;
  Welder welder_;
  std::vector<std::uint32_t> corners_;
  bool in_loop_ = false, ended_ = false;
};

}  // namespace

RawGeometry read_stl(const std::shared_ptr<const MappedFile>& file, const Context& context) {
  RawGeometry geometry;
  geometry.path = file->path();
  const bool solid = file->text().starts_with("solid");
  const bool has_zero = file->text().substr(0, 1024).find('\0') != std::string_view::npos;
  const bool exact = file->size() >= binary_head &&
                     binary_head + binary_facet * std::uint64_t{load<std::uint32_t>(file->data() + 80)} == file->size();
  if (!exact && solid && !has_zero)
    TextParser(*file, geometry).read(context);
  else
    read_binary(*file, geometry);
  return geometry;
}

}  // namespace atrium::io
