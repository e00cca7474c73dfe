#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "graph/api/context.hpp"
#include "graph/api/mapped_file.hpp"
#include "modules/io/concave_faces.hpp"
#include "modules/io/scalar.hpp"

namespace atrium::io {

/// What a column of a file means to us.
enum class Role : std::uint8_t {
  x,
  y,
  z,
  nx,
  ny,
  nz,
  red,
  green,
  blue,
  packed_colour,
  intensity,
  label,
  source,
  none  // `none` is also the number of roles
};
inline constexpr std::size_t role_count = static_cast<std::size_t>(Role::none);

/// The role of a property, field or column by its name, in the spellings of common programs ("nx", "normal_x",
/// "diffuse_red", "scalar_Intensity", "classification"); upper and lower case are the same.
Role role_of(std::string_view name);

/// Numbers at equal distances in memory: a property of a binary file in place, or of a decoded table.
struct Column {
  const std::byte* data = nullptr;  ///< null: the file has no such column
  std::size_t stride = 0;           ///< bytes from one to the next
  Scalar type = Scalar::none;
  bool swapped = false;  ///< in the other byte order than this machine's
  bool whole = false;    ///< the file declares whole numbers, be they stored as others here
  explicit operator bool() const { return data != nullptr; }
};

class PointSource;
class RowTable;

/// What a reader found in a file: columns still in the file's number types, and triangles; or a source of points.
/// decode_cloud and decode_mesh turn it into port values.
struct RawGeometry {
  std::string path;
  std::size_t count = 0;  ///< vertices; of a source the most that it can give
  std::array<Column, role_count> columns;
  std::shared_ptr<const PointSource> source;  ///< if set, the points come from here, block by block, not from `columns`
  std::shared_ptr<const RowTable>
      rows;  ///< if set, there are no columns until load_rows(): a table that is not read yet
  std::optional<double> metres_per_unit;                   ///< if the format or the file says it
  std::string crs;                                         ///< coordinate reference system as Cloud has it
  std::vector<std::array<std::uint32_t, 3>> triangles;     ///< every index below `count`
  std::vector<FaceFan> fans;                               ///< triangles that are one face together
  std::vector<std::int32_t> classes, storeys, primitives;  ///< per triangle, or empty
  std::size_t skipped_faces = 0;                           ///< faces of fewer than three corners
  std::optional<Eigen::Vector3d> viewpoint;                ///< sensor's place if the file states one, in its units
  std::vector<Eigen::Vector3d> sensors;                    ///< several of them; the column `source` is an index here
  std::size_t image_width = 0;  ///< of an image of points, row by row, as one shot of a depth camera is; 0: it is none
  bool y_up = false;            ///< files of that format usually have y up, as Cloud has it
  bool float_table =
      false;  ///< the numbers are doubles, but the coordinates in the file, or in one of several, float32
  std::vector<std::shared_ptr<const void>> storage;      ///< what the columns point into
  std::vector<std::shared_ptr<const MappedFile>> files;  ///< that it was read from, or is read from block by block

  Column& column(Role role) { return columns[static_cast<std::size_t>(role)]; }
  const Column& column(Role role) const { return columns[static_cast<std::size_t>(role)]; }
};

/// Rows of doubles for what has to be decoded first (text, records of variable length): one column a role.
class Table {
 public:
  /// Holds a row even where there are none, so that its columns have an address and say that they are there.
  Table(std::size_t rows, std::vector<Role> roles)
      : roles_(std::move(roles)), values_(std::max<std::size_t>(rows, 1) * roles_.size()) {}
  double* row(std::size_t i) { return values_.data() + i * roles_.size(); }
  std::size_t width() const { return roles_.size(); }
  /// Makes the table's columns those of the geometry, which keeps it alive.
  static void attach(std::shared_ptr<Table> table, RawGeometry& geometry);

 private:
  std::vector<Role> roles_;
  std::vector<double> values_;
};

/// Rows of numbers of a text file, in blocks that are parsed when they are wanted, in any order and side by side.
class RowTable {
 public:
  RowTable() = default;
  virtual ~RowTable() = default;
  RowTable(const RowTable&) = delete;
  RowTable& operator=(const RowTable&) = delete;

  virtual const std::vector<Role>& roles() const = 0;  ///< of the columns
  virtual std::size_t blocks() const = 0;
  virtual std::size_t rows(std::size_t block) const = 0;
  /// The rows of a block; of columns whose role is `none` in `wanted` nothing is read. Throws Error, with file and
  /// line.
  virtual std::shared_ptr<Table> read(std::size_t block, const std::vector<Role>& wanted) const = 0;
  /// One row, as read() does.
  virtual void read_row(std::size_t row, double* to) const = 0;
  /// All rows. Of several errors the first in the file is thrown.
  virtual std::shared_ptr<Table> read_all(const Context& context) const = 0;
};

/// Reads the geometry's rows, if it has such, into its columns: 8 bytes a number.
void load_rows(RawGeometry& geometry, const Context& context);

/// Gives back the memory that pages of the geometry's files take in this process: see MappedFile.
void drop_pages(const RawGeometry& geometry);

/// Throws Error unless the geometry has x, y and z. `names`: what the file does have.
void require_position(const RawGeometry& geometry, std::string_view names);

}  // namespace atrium::io
