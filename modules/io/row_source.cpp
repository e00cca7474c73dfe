#include "modules/io/row_source.hpp"

#include <algorithm>

#include "modules/io/text_layout.hpp"

namespace atrium::io {
namespace {

bool is_colour(Role role) { return role == Role::red || role == Role::green || role == Role::blue; }

}  // namespace

RowSource::RowSource(std::shared_ptr<const MappedFile> file, Lines lines, const TextDialect& dialect,
                     std::vector<Role> roles, std::vector<RowScan> scans, bool places_known)
    : file_(std::move(file)),
      lines_(std::move(lines)),
      dialect_(dialect),
      columns_(std::move(roles)),
      scans_(std::move(scans)) {
  for (const Role role : columns_)
    if (role != Role::none) provide(role);
  if (places_known && scans_.size() > 1) provide(Role::source);
  if (has(Role::red) && has_fractions_of_colours()) colour_factor_ = 255;
}

std::vector<Role> RowSource::columns_of(const RowScan& scan) const {
  auto columns = columns_;
  if (scan.columns > 0) columns.resize(scan.columns);
  return columns;
}

/// Whether the colours of the first rows are all within 0 … 1, and not all whole.
bool RowSource::has_fractions_of_colours() const {
  constexpr std::size_t looked_at = 1000;
  std::vector<double> numbers(columns_.size());
  bool fractions = false, within = true;
  const RowScan& scan = *std::find_if(scans_.begin(), scans_.end(),
                                      [&](const RowScan& s) { return s.columns == 0 || s.columns == columns_.size(); });
  for (std::size_t p = 0; p < lines_.pieces().size() && within; ++p)
    lines_.rows_of(p, scan.first, scan.first + std::min(scan.rows, looked_at), [&](const Row& row) {
      read_numbers(file_->path(), row, dialect_, columns_, numbers.data());
      for (std::size_t c = 0; c < columns_.size(); ++c) {
        if (!is_colour(columns_[c])) continue;
        within = within && numbers[c] >= 0 && numbers[c] <= 1;
        fractions = fractions || (numbers[c] > 0 && numbers[c] < 1);
      }
    });
  return within && fractions;
}

void RowSource::read(std::size_t block, PointBlock& to) const {
  const Lines::Piece& piece = lines_.pieces()[block];
  to.resize(piece.rows, roles());
  to.misses = 0;
  std::vector<double> numbers(columns_.size());
  std::size_t kept = 0;
  // The first scan that ends behind the piece's first row.
  auto scan = std::upper_bound(scans_.begin(), scans_.end(), piece.first_row,
                               [](std::size_t row, const RowScan& s) { return row < s.first + s.rows; });
  for (; scan != scans_.end() && scan->first < piece.first_row + piece.rows; ++scan) {
    const auto number = static_cast<double>(scan - scans_.begin());
    const std::vector<Role> columns = columns_of(*scan);
    std::fill(numbers.begin(), numbers.end(), 0);
    lines_.rows_of(block, scan->first, scan->first + scan->rows, [&](const Row& row) {
      read_numbers(file_->path(), row, dialect_, columns, numbers.data());
      for (std::size_t c = 0; c < columns_.size(); ++c)
        if (columns_[c] != Role::none)
          to.of(columns_[c])[kept] = is_colour(columns_[c]) ? colour_factor_ * numbers[c] : numbers[c];
      double &x = to.of(Role::x)[kept], &y = to.of(Role::y)[kept], &z = to.of(Role::z)[kept];
      if (scan->zeros_are_misses && x == 0 && y == 0 && z == 0) {
        ++to.misses;
        return;
      }
      if (scan->moved) {
        const Eigen::Vector3d p = scan->to_file * Eigen::Vector3d(x, y, z);
        x = p.x();
        y = p.y();
        z = p.z();
      }
      if (has(Role::source)) to.of(Role::source)[kept] = number;
      ++kept;
    });
  }
  to.size = kept;
}

}  // namespace atrium::io
