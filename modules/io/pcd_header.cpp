#include "modules/io/pcd_header.hpp"

#include <fmt/format.h>

#include "modules/io/header_lines.hpp"
#include "modules/io/lines.hpp"

namespace atrium::io {
namespace {

class PcdHeaderParser {
 public:
  explicit PcdHeaderParser(const MappedFile& file)
      : lines_(file, "the header ends without a line 'DATA' (truncated, or not a PCD file?)") {}

  PcdHeader parse() {
    for (bool more = true; more;) {
      std::string_view line = lines_.next();
      const std::string keyword = lower_case(next_token(line));
      if (!keyword.empty() && !keyword.starts_with('#')) more = read(keyword, line);
    }
    finish();
    return std::move(header_);
  }

 private:
  static std::vector<std::string_view> tokens(std::string_view line) {
    std::vector<std::string_view> all;
    for (auto t = next_token(line); !t.empty(); t = next_token(line)) all.push_back(t);
    return all;
  }

  /// `keyword`: in lower case. False after the last line of the header.
  bool read(std::string_view keyword, std::string_view line) {
    const auto values = tokens(line);
    if (keyword == "version") return true;
    if (keyword == "data") return read_data(values);
    if (values.empty()) lines_.fail(quote(keyword) + " without values");
    if (keyword == "fields" || keyword == "columns")
      names_.assign(values.begin(), values.end());
    else if (keyword == "size")
      sizes_ = wholes(values);
    else if (keyword == "count")
      counts_ = wholes(values);
    else if (keyword == "type")
      types_.assign(values.begin(), values.end());
    else if (keyword == "width")
      width_ = lines_.whole(values[0]);
    else if (keyword == "height")
      height_ = lines_.whole(values[0]);
    else if (keyword == "points")
      points_ = lines_.whole(values[0]);
    else if (keyword == "viewpoint")
      read_viewpoint(values);
    else
      lines_.fail("unknown keyword " + quote(keyword) + " (not a PCD file?)");
    return true;
  }

  std::vector<std::uint64_t> wholes(const std::vector<std::string_view>& values) const {
    std::vector<std::uint64_t> result;
    result.reserve(values.size());
    for (const auto v : values) result.push_back(lines_.whole(v));
    return result;
  }

  void read_viewpoint(const std::vector<std::string_view>& values) {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    if (values.size() != 7) lines_.fail("VIEWPOINT has 7 numbers: tx ty tz qw qx qy qz");
    for (std::size_t a = 0; a < 3; ++a)
      if (!parse_number(values[a], place[static_cast<Eigen::Index>(a)])) lines_.fail(no_number(values[a]));
    header_.viewpoint = place;
  }

  bool read_data(const std::vector<std::string_view>& values) {
    const std::string kind = lower_case(values.empty() ? std::string_view{} : values[0]);
    if (kind == "ascii")
      header_.data = PcdHeader::Data::ascii;
    else if (kind == "binary")
      header_.data = PcdHeader::Data::binary;
    else if (kind == "binary_compressed")
      header_.data = PcdHeader::Data::compressed;
    else
      lines_.fail("unknown DATA " + quote(kind) + "; known: ascii, binary, binary_compressed");
    return false;
  }

  Scalar scalar(std::string_view name, std::uint64_t size) const {
    const std::string type = lower_case(name);
    if (type == "f" && size == 4) return Scalar::f32;
    if (type == "f" && size == 8) return Scalar::f64;
    constexpr Scalar table[2][4] = {{Scalar::i8, Scalar::i16, Scalar::i32, Scalar::i64},
                                    {Scalar::u8, Scalar::u16, Scalar::u32, Scalar::u64}};
    for (int k = 0; k < 4; ++k)
      if (size == std::uint64_t{1} << k && (type == "i" || type == "u")) return table[type == "i" ? 0 : 1][k];
    lines_.fail(fmt::format("a field of TYPE {} and SIZE {}; there are I and U of 1, 2, 4, 8 bytes and F of 4, 8",
                            quote(name), size));
  }

  void finish() {
    const std::size_t n = names_.size();
    if (n == 0) lines_.fail("the header has no line 'FIELDS'");
    if (sizes_.empty()) sizes_.assign(n, 4);
    if (types_.empty()) types_.assign(n, "F");
    if (counts_.empty()) counts_.assign(n, 1);
    if (sizes_.size() != n || types_.size() != n || counts_.size() != n)
      lines_.fail(
          fmt::format("{} FIELDS, but {} SIZE, {} TYPE and {} COUNT", n, sizes_.size(), types_.size(), counts_.size()));
    for (std::size_t i = 0; i < n; ++i) {
      if (counts_[i] > 65536) lines_.fail(fmt::format("the field {} has a COUNT of {}", quote(names_[i]), counts_[i]));
      header_.fields.push_back({std::string(names_[i]), scalar(types_[i], sizes_[i]), counts_[i], header_.record});
      header_.record += header_.fields.back().size();
    }
    count_points();
    header_.body = lines_.position();
    header_.lines = lines_.count();
  }

  void count_points() {
    header_.height = height_.value_or(1);
    if (!width_ && !points_) lines_.fail("the header has neither WIDTH nor POINTS");
    header_.width = width_ ? *width_ : *points_;
    const auto product = static_cast<unsigned __int128>(header_.width) * header_.height;
    header_.points = points_.value_or(header_.width * header_.height);
    if (product != header_.points)
      lines_.fail(
          fmt::format("WIDTH {} times HEIGHT {} are not POINTS {}", header_.width, header_.height, header_.points));
  }

  HeaderLines lines_;
  std::vector<std::string_view> names_, types_;
  std::vector<std::uint64_t> sizes_, counts_;
  std::optional<std::uint64_t> width_, height_, points_;
  PcdHeader header_;
};

}  // namespace

PcdHeader read_pcd_header(const MappedFile& file) { return PcdHeaderParser(file).parse(); }

}  // namespace atrium::io
