#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "graph/api/error.hpp"
#include "modules/io/faces.hpp"
#include "modules/io/lines.hpp"
#include "modules/io/ply_body.hpp"

namespace atrium::io {
namespace {

/// Reads the numbers of one row.
class RowReader {
 public:
  RowReader(const std::string& path, const PlyElement& element, const Row& row)
      : path_(path), element_(element), row_(row), rest_(row.text) {}

  double number(const PlyProperty& property) {
    const std::string_view token = next_token(rest_);
    double v = 0;
    if (token.empty())
      fail(fmt::format("{} has {} properties, but the line ends before '{}'", element_.name, element_.properties.size(),
                       property.name));
    if (!parse_number(token, v)) fail(no_number(token) + " ('" + property.name + "')");
    return v;
  }
  /// The length of a list, at most what the line can hold.
  std::size_t list_length(const PlyProperty& property) {
    const double count = number(property);
    if (!(count >= 0) || count != std::floor(count)) fail(fmt::format("a list of {} items", count));
    if (count > static_cast<double>(rest_.size()))
      fail(fmt::format("a list of {} items, but the line is too short for them", count));
    return static_cast<std::size_t>(count);
  }
  void finish() {
    if (const std::string_view token = next_token(rest_); !token.empty())
      fail(
          fmt::format("{} has {} properties, but {} follows", element_.name, element_.properties.size(), quote(token)));
  }
  std::string where() const { return fmt::format("{}:{}", path_, row_.line); }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw Error(where() + ": " + what); }

  const std::string& path_;
  const PlyElement& element_;
  const Row& row_;
  std::string_view rest_;
};

struct TextBody {
  const MappedFile& file;
  const Lines& lines;
  RawGeometry& geometry;
  const Context& context;

  void read_vertices(const PlyElement& element, std::size_t first) const {
    const std::vector<Role> roles = roles_of(element);
    std::vector<Role> kept;
    for (const Role role : roles)
      if (role != Role::none) kept.push_back(role);
    auto table = std::make_shared<Table>(element.count, kept);
    lines.for_rows(first, first + element.count, context, [&](std::size_t, const Row& row) {
      RowReader reader(file.path(), element, row);
      double* to = table->row(row.index - first);
      for (std::size_t p = 0; p < roles.size(); ++p) {
        const PlyProperty& property = element.properties[p];
        if (property.is_list())
          skip_list(reader, property);
        else if (const double v = reader.number(property); roles[p] != Role::none)
          *to++ = v;
      }
      reader.finish();
    });
    Table::attach(std::move(table), geometry);
    for (std::size_t p = 0; p < roles.size(); ++p)
      if (roles[p] != Role::none) geometry.column(roles[p]).whole = !is_floating(element.properties[p].type);
  }

  /// Faces, or strips of triangles.
  void read_faces(const PlyElement& element, std::size_t first) const {
    const bool strips = part_of(file.path(), element) == PlyPart::strips;
    std::vector<FaceList> faces(lines.pieces().size());
    std::array<bool, 3> has{};
    for (const auto& p : element.properties)
      if (const int a = face_attribute(p.name); a >= 0 && !p.is_list()) has[static_cast<std::size_t>(a)] = true;
    lines.for_rows(first, first + element.count, context, [&](std::size_t piece, const Row& row) {
      RowReader reader(file.path(), element, row);
      std::vector<std::uint32_t> corners;
      std::array<std::int32_t, 3> values{};
      for (const auto& property : element.properties) {
        if (is_corner_list(property)) {
          corners.resize(reader.list_length(property));
          for (auto& c : corners) {
            const double corner = reader.number(property);
            c = strips && ends_strip(corner) ? strip_end : vertex_index(corner, geometry.count, reader.where());
          }
        } else if (property.is_list()) {
          skip_list(reader, property);
        } else {
          const double v = reader.number(property);
          const int a = face_attribute(property.name);
          if (a >= 0)
            values[static_cast<std::size_t>(a)] =
                std::isnan(v) ? -1 : static_cast<std::int32_t>(std::clamp(v, -2147483648.0, 2147483647.0));
        }
      }
      reader.finish();
      if (strips)
        faces[piece].add_strips(corners, has, values);
      else
        faces[piece].add(corners, has, values);
    });
    FaceList::join(faces, geometry);
  }

  void read_camera(const PlyElement& element, std::size_t first) const {
    lines.for_rows(first, first + 1, context, [&](std::size_t, const Row& row) {
      RowReader reader(file.path(), element, row);
      Eigen::Vector3d place = Eigen::Vector3d::Zero();
      int found = 0;
      for (const auto& property : element.properties) {
        const double v = reader.number(property);
        const int axis = viewpoint_axis(property);
        if (axis < 0) continue;
        place[axis] = v;
        ++found;
      }
      if (found == 3) geometry.viewpoint = place;
    });
  }

  void read_sensors(const PlyElement& element, std::size_t first) const {
    geometry.sensors.resize(element.count);
    lines.for_rows(first, first + element.count, context, [&](std::size_t, const Row& row) {
      RowReader reader(file.path(), element, row);
      for (const auto& property : element.properties) {
        const double v = reader.number(property);
        if (const int axis = sensor_axis(property); axis >= 0) geometry.sensors[row.index - first][axis] = v;
      }
      reader.finish();
    });
  }

  static void skip_list(RowReader& reader, const PlyProperty& property) {
    for (std::size_t n = reader.list_length(property); n > 0; --n) reader.number(property);
  }
};

/// Whether two texts have as many lines that are not blank.
bool same_lines(std::string_view a, std::string_view b) {
  const auto count = [](std::string_view text) {
    std::size_t lines = 0;
    for_lines(text, [&](std::string_view line) {
      lines += line.find_first_not_of(" \t") == std::string_view::npos ? 0 : 1;
      return true;
    });
    return lines;
  };
  return count(a) == count(b);
}

void read_lines(const MappedFile& file, std::string_view text, const PlyHeader& header, RawGeometry& geometry,
                const Context& context) {
  const Lines lines(text, header.lines + 1, false, context);
  const TextBody body{file, lines, geometry, context};
  std::size_t first = 0;
  for (const auto& element : header.elements) {
    if (element.properties.empty()) continue;
    if (element.count > lines.rows() - first)
      throw Error(
          fmt::format("{}: truncated: {} lines of element '{}' are expected, but the file ends after {} of them "
                      "(line {})",
                      file.path(), element.count, element.name, lines.rows() - first, lines.end_line()),
          "the header promises more than the file holds: copy or export it again");
    switch (part_of(file.path(), element)) {
      case PlyPart::vertices: body.read_vertices(element, first); break;
      case PlyPart::faces:
      case PlyPart::strips: body.read_faces(element, first); break;
      case PlyPart::sensors: body.read_sensors(element, first); break;
      case PlyPart::camera: body.read_camera(element, first); break;
      case PlyPart::other: break;
    }
    first += element.count;
  }
}

}  // namespace

void read_ply_text(const MappedFile& file, const PlyHeader& header, RawGeometry& geometry, const Context& context) {
  const std::string_view text = file.text().substr(header.body);
  const RawGeometry before = geometry;
  try {
    read_lines(file, text, header, geometry, context);
  } catch (const Error&) {
    const auto other = one_record_a_line(text, header);
    if (!other) throw;
    if (same_lines(*other, text)) throw;
    geometry = before;
    try {
      read_lines(file, *other, header, geometry, context);
    } catch (const Error& error) {
      throw Error(std::string(error.what()) + " (lines are counted as if each record had one, as the file's are not)",
                  error.help());
    }
  }
}

}  // namespace atrium::io
