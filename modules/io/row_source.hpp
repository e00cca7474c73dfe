#pragma once
#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "graph/api/mapped_file.hpp"
#include "modules/io/lines.hpp"
#include "modules/io/point_source.hpp"
#include "modules/io/text_fields.hpp"

namespace atrium::io {

/// Rows of a text file that are points of one scan.
struct RowScan {
  std::size_t first = 0, rows = 0;
  Eigen::Affine3d to_file = Eigen::Affine3d::Identity();
  bool moved = false;             ///< to_file is not the identity
  bool zeros_are_misses = false;  ///< (0, 0, 0) is a ray that hit nothing
  std::size_t columns = 0;        ///< how many of the file's columns this scan has; 0: all
};

/// The points of a text file, one a row, in scans: a block is a piece of the file of about a megabyte. Colours are as
/// they stand there, 0 … 255; times 255 where those of the first rows are fractions of 1.
class RowSource : public PointSource {
 public:
  /// `roles`: of the columns, the same in all scans, which come in the order of rows; what a scan of fewer columns
  /// lacks is 0. Several scans are told apart by
  /// Role::source if their scanners' places are known. A row with another number of columns is an error.
  RowSource(std::shared_ptr<const MappedFile> file, Lines lines, const TextDialect& dialect, std::vector<Role> roles,
            std::vector<RowScan> scans, bool places_known = false);

  std::size_t blocks() const override { return lines_.pieces().size(); }
  std::size_t capacity(std::size_t block) const override { return lines_.pieces()[block].rows; }
  void read(std::size_t block, PointBlock& to) const override;
  std::size_t samples() const override { return 10; }

 private:
  bool has_fractions_of_colours() const;
  std::vector<Role> columns_of(const RowScan& scan) const;

  std::shared_ptr<const MappedFile> file_;
  Lines lines_;
  TextDialect dialect_;
  std::vector<Role> columns_;
  std::vector<RowScan> scans_;
  double colour_factor_ = 1;
};

}  // namespace atrium::io
