#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "graph/api/error.hpp"
#include "modules/io/faces.hpp"
#include "modules/io/ply_body.hpp"

namespace atrium::io {
namespace {

/// Walks the elements of the body in the file's order. No count is trusted beyond what the file's size allows.
class BinaryBody {
 public:
  BinaryBody(const MappedFile& file, const PlyHeader& header, RawGeometry& geometry)
      : file_(file),
        geometry_(geometry),
        place_(header.body),
        swapped_((header.format == PlyHeader::Format::little_endian) != (std::endian::native == std::endian::little)) {}

  void read(const PlyElement& element) {
    const std::size_t record = element.record_size();
    if (record == 0) return;
    if (element.count > left() / record) truncated(element, element.count, record);
    switch (part_of(file_.path(), element)) {
      case PlyPart::vertices: read_vertices(element); break;
      case PlyPart::faces:
      case PlyPart::strips: read_faces(element); break;
      case PlyPart::sensors: read_sensors(element); break;
      case PlyPart::camera: read_camera(element); break;
      case PlyPart::other: pass_over(element); break;
    }
  }

 private:
  std::size_t left() const { return file_.size() - place_; }

  [[noreturn]] void truncated(const PlyElement& element, std::uint64_t records, std::size_t size) const {
    throw Error(fmt::format("{}: truncated: {} × {} of {} bytes{} are to follow byte {}, but the file has {} bytes",
                            file_.path(), records, element.name, size, element.has_lists() ? " at least" : "", place_,
                            file_.size()),
                "the header promises more than the file holds: copy or export it again");
  }

  void need(std::uint64_t count, std::size_t size, const PlyElement& element, std::uint64_t index) const {
    if (count <= left() / size) return;
    throw Error(
        fmt::format("{}: truncated in {} {} of {}: {} × {} bytes are to follow byte {}, but the file has {} bytes",
                    file_.path(), element.name, index, element.count, count, size, place_, file_.size()),
        "the header promises more than the file holds: copy or export it again");
  }

  double take(Scalar type) {
    const double v = load_number(type, file_.data() + place_, swapped_);
    place_ += size_of(type);
    return v;
  }

  std::uint64_t take_count(const PlyProperty& property, const PlyElement& element, std::uint64_t index) {
    need(1, size_of(property.count_type), element, index);
    const std::size_t at = place_;
    const double count = take(property.count_type);
    if (count < 0)
      throw Error(
          fmt::format("{}: {} {} at byte {}: a list of {} items", file_.path(), element.name, index, at, count));
    need(static_cast<std::uint64_t>(count), size_of(property.type), element, index);
    return static_cast<std::uint64_t>(count);
  }

  /// Visits each number that is no list item: number(property, value); each record's end: done(index). Skips lists.
  template <class Number, class Done>
  void walk(const PlyElement& element, Number&& number, Done&& done) {
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const PlyProperty& property = element.properties[p];
        if (property.is_list()) {
          const std::uint64_t count = take_count(property, element, i);
          place_ += count * size_of(property.type);
        } else {
          need(1, size_of(property.type), element, i);
          number(p, take(property.type));
        }
      }
      done(i);
    }
  }

  void pass_over(const PlyElement& element) {
    if (element.has_lists())
      walk(
          element, [](std::size_t, double) {}, [](std::uint64_t) {});
    else
      place_ += element.record_size() * element.count;
  }

  void read_vertices(const PlyElement& element) {
    const std::vector<Role> roles = roles_of(element);
    if (element.has_lists()) {
      // Records of different length: the numbers are gathered into a table.
      auto table = std::make_shared<Table>(element.count, roles);
      std::uint64_t row = 0;
      walk(
          element, [&](std::size_t p, double v) { table->row(row)[p] = v; }, [&](std::uint64_t i) { row = i + 1; });
      Table::attach(std::move(table), geometry_);
      return;
    }
    const std::size_t record = element.record_size();
    std::size_t offset = place_;
    for (std::size_t p = 0; p < roles.size(); ++p) {
      const Scalar type = element.properties[p].type;
      if (roles[p] != Role::none) geometry_.column(roles[p]) = {file_.data() + offset, record, type, swapped_};
      offset += size_of(type);
    }
    place_ += record * element.count;
  }

  void read_camera(const PlyElement& element) {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    bool has[3] = {false, false, false};
    std::uint64_t record = 0;
    walk(
        element,
        [&](std::size_t p, double v) {
          const int axis = viewpoint_axis(element.properties[p]);
          if (axis < 0 || record > 0) return;
          place[axis] = v;
          has[axis] = true;
        },
        [&](std::uint64_t i) { record = i + 1; });
    if (has[0] && has[1] && has[2]) geometry_.viewpoint = place;
  }

  void read_sensors(const PlyElement& element) {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    walk(
        element,
        [&](std::size_t p, double v) {
          if (const int axis = sensor_axis(element.properties[p]); axis >= 0) place[axis] = v;
        },
        [&](std::uint64_t) { geometry_.sensors.push_back(place); });
  }

  void read_corners(const PlyProperty& property, const PlyElement& element, std::uint64_t index, bool strips,
                    std::vector<std::uint32_t>& corners) {
    const std::uint64_t count = take_count(property, element, index);
    corners.resize(count);
    const std::byte* from = file_.data() + place_;
    with_scalar(property.type, [&](auto t) {
      using T = decltype(t);
      for (std::uint64_t k = 0; k < count; ++k) {
        const auto corner = static_cast<double>(load<T>(from + k * sizeof(T), swapped_));
        if (corner >= 0 && corner < static_cast<double>(geometry_.count) && corner == std::floor(corner))
          corners[k] = static_cast<std::uint32_t>(corner);
        else if (strips && ends_strip(corner))
          corners[k] = strip_end;
        else
          vertex_index(corner, geometry_.count, fmt::format("{}: face {} at byte {}", file_.path(), index, place_));
      }
    });
    place_ += count * size_of(property.type);
  }

  /// Faces, or strips of triangles.
  void read_faces(const PlyElement& element) {
    const bool strips = part_of(file_.path(), element) == PlyPart::strips;
    std::vector<FaceList> faces(1);
    std::vector<std::uint32_t> corners;
    std::array<bool, 3> has{};
    std::array<std::int32_t, 3> values{};
    std::vector<int> attribute;
    for (const auto& p : element.properties) attribute.push_back(p.is_list() ? -1 : face_attribute(p.name));
    for (const int a : attribute)
      if (a >= 0) has[static_cast<std::size_t>(a)] = true;
    faces[0].triangles.reserve(element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      corners.clear();
      for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const PlyProperty& property = element.properties[p];
        if (is_corner_list(property)) {
          read_corners(property, element, i, strips, corners);
        } else if (property.is_list()) {
          const std::uint64_t count = take_count(property, element, i);
          place_ += count * size_of(property.type);
        } else {
          need(1, size_of(property.type), element, i);
          const double v = take(property.type);
          if (attribute[p] >= 0) values[static_cast<std::size_t>(attribute[p])] = whole(v);
        }
      }
      if (strips)
        faces[0].add_strips(corners, has, values);
      else
        faces[0].add(corners, has, values);
    }
    FaceList::join(faces, geometry_);
  }

  static std::int32_t whole(double v) {
    return std::isnan(v) ? -1 : static_cast<std::int32_t>(std::clamp(v, -2147483648.0, 2147483647.0));
  }

  const MappedFile& file_;
  RawGeometry& geometry_;
  std::size_t place_;
  bool swapped_;
};

}  // namespace

void read_ply_binary(const MappedFile& file, const PlyHeader& header, RawGeometry& geometry) {
  BinaryBody body(file, header, geometry);
  for (const auto& element : header.elements) body.read(element);
}

}  // namespace atrium::io
