#include "modules/io/ptx_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "graph/api/error.hpp"
#include "modules/io/row_source.hpp"
#include "modules/io/text_layout.hpp"

namespace atrium::io {
namespace {

constexpr std::size_t header_rows = 10;
constexpr std::array<std::size_t, header_rows> header_widths{1, 1, 3, 3, 3, 3, 4, 4, 4, 4};

std::size_t width_of(std::string_view text) {
  std::size_t width = 0;
  while (!next_token(text).empty()) ++width;
  return width;
}

class PtxReader {
 public:
  PtxReader(const std::shared_ptr<const MappedFile>& file, const Context& context)
      : context_(context), file_(file), lines_(without_mark(file->text()), 1, true, context) {}

  RawGeometry read() {
    std::size_t row = 0;
    while (row < lines_.rows()) row = read_header(row);
    constexpr std::size_t most_scans = 65536;  // a point's source has 16 bits
    if (scans_.size() > most_scans)
      throw Error(
          fmt::format("{}: {} scans; the most that can be handled are {}", file_->path(), scans_.size(), most_scans));
    if (scans_.empty()) throw Error(file_->path() + ": no points: the file has no scan with a row");
    std::vector<Role> roles{Role::x, Role::y, Role::z, Role::intensity, Role::red, Role::green, Role::blue};
    std::size_t widest = 0;
    for (auto& scan : scans_) {
      const Row first = lines_.row(scan.first);
      scan.columns = width_of(first.text);
      if (scan.columns != 3 && scan.columns != 4 && scan.columns != 7)
        fail(first, fmt::format("{} values; a point of PTX has x y z intensity, and perhaps r g b", scan.columns));
      widest = std::max(widest, scan.columns);
    }
    roles.resize(widest);
    warn_of_narrow_scans(file_->path(), scans_, roles, context_);
    RawGeometry geometry;
    geometry.path = file_->path();
    geometry.metres_per_unit = 1.0;
    geometry.sensors = places_;
    for (const auto& scan : scans_) geometry.count += scan.rows;
    geometry.source = std::make_shared<const RowSource>(file_, std::move(lines_), TextDialect{}, std::move(roles),
                                                        std::move(scans_), true);
    return geometry;
  }

 private:
  [[noreturn]] void fail(const Row& row, const std::string& what) const {
    throw Error(fmt::format("{}:{}: {}", file_->path(), row.line, what));
  }

  /// The first row after the scan that begins here.
  std::size_t read_header(std::size_t first) {
    if (lines_.rows() - first < header_rows)
      fail(lines_.row(first),
           fmt::format("cut short: the {} lines at the head of a scan are not all there", header_rows));
    std::array<std::array<double, 4>, header_rows> values{};
    for (std::size_t i = 0; i < header_rows; ++i)
      read_numbers(file_->path(), lines_.row(first + i), {}, std::vector<Role>(header_widths[i], Role::x),
                   values[i].data());
    const std::size_t columns = count(values[0][0], lines_.row(first), "columns");
    const std::size_t rows = count(values[1][0], lines_.row(first + 1), "rows");
    const std::size_t left = lines_.rows() - first - header_rows;
    if (rows > 0 && columns > left / rows)
      throw Error(fmt::format("{}:{}: cut short: {} × {} points are promised, but {} lines follow", file_->path(),
                              lines_.row(first).line, columns, rows, left),
                  "copy or export the file again");
    RowScan scan{first + header_rows, columns * rows, {}, true, true, 0};
    scan.to_file.setIdentity();
    for (int r = 0; r < 4; ++r)  // rows of the file are columns here: p' = p · M
      for (int c = 0; c < 3; ++c)
        scan.to_file(c, r) = values[6 + static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
    const Eigen::Vector3d place(values[2][0], values[2][1], values[2][2]);
    if (!scan.to_file.matrix().allFinite() || !place.allFinite())
      fail(lines_.row(first + 2), "the scanner's place or the matrix is not finite");
    if (std::abs(scan.to_file.linear().determinant()) < 1e-12)
      fail(lines_.row(first + 6), "the matrix flattens the points: its determinant is 0");
    if (scan.rows > 0) {
      scans_.push_back(scan);
      // The points are around the matrix's zero. Without a matrix they are in the common frame already.
      const bool moved = !scan.to_file.matrix().isApprox(Eigen::Matrix4d::Identity());
      places_.emplace_back(moved ? Eigen::Vector3d(scan.to_file.translation()) : place);
    }
    return first + header_rows + columns * rows;
  }

  std::size_t count(double value, const Row& row, const char* what) const {
    constexpr double most = 1e9;
    if (!(value >= 0 && value <= most) || value != std::floor(value))
      fail(row, fmt::format("{} is no number of {}", quote(row.text), what));
    return static_cast<std::size_t>(value);
  }

  const Context& context_;
  std::shared_ptr<const MappedFile> file_;
  Lines lines_;
  std::vector<RowScan> scans_;
  std::vector<Eigen::Vector3d> places_;
};

}  // namespace

bool is_ptx(std::string_view text) {
  std::size_t line_number = 0;
  bool fits = true;
  for_lines(without_mark(text), [&](std::string_view line) {
    const std::size_t width = header_widths[line_number];
    std::size_t numbers = 0;
    double value = 0;
    for (auto token = next_token(line); !token.empty() && fits; token = next_token(line), ++numbers)
      fits = parse_number(token, value) && (width != 1 || value == std::floor(value));
    fits = fits && numbers == width;
    return fits && ++line_number < header_rows;
  });
  return fits && line_number == header_rows;
}

RawGeometry read_ptx(const std::shared_ptr<const MappedFile>& file, const Context& context) {
  return PtxReader(file, context).read();
}

}  // namespace atrium::io
