#include "modules/io/gltf_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

#include "graph/api/error.hpp"
#include "graph/api/text.hpp"
#include "modules/io/faces.hpp"
#include "modules/io/gltf_accessors.hpp"
#include "modules/io/gltf_colours.hpp"
#include "modules/io/gltf_scene.hpp"
#include "modules/io/surface_classes.hpp"
#include "modules/io/weld.hpp"

namespace atrium::io {
namespace {

/// What the columns of the geometry point into.
struct Vertices {
  std::vector<Eigen::Vector3d> places;
  std::vector<Eigen::Vector3f> normals;
  std::vector<Colour> colours;
};

template <class T>
void take(std::vector<T>& column, const std::vector<std::uint32_t>& kept) {
  if (column.empty()) return;
  for (std::size_t i = 0; i < kept.size(); ++i) column[i] = column[kept[i]];
  column.resize(kept.size());
}

enum Mode : std::uint8_t { mode_points = 0, mode_lines = 1, mode_triangles = 4, mode_strip = 5, mode_fan = 6 };

/// Whether the file was written by io.write_mesh, and how it says that true coordinates follow from its own.
std::optional<Eigen::Affine3d> own_frame(const JsonField& root) {
  const JsonField asset = root["asset"];
  if (!asset.has("generator") || !asset["generator"].is_text() || asset["generator"].text() != "Atrium") return {};
  if (!asset.has("extras") || !asset["extras"].has("to_true")) return {};
  const JsonField list = asset["extras"]["to_true"];
  if (list.size() != 16) list.fail("is no matrix of 16 numbers");
  Eigen::Affine3d frame = Eigen::Affine3d::Identity();
  for (std::size_t i = 0; i < 16; ++i)
    if (i % 4 != 3) frame.matrix()(static_cast<int>(i % 4), static_cast<int>(i / 4)) = list.at(i).number();
  return frame;
}

class GltfReader {
 public:
  GltfReader(const std::shared_ptr<const MappedFile>& file, const Context& context)
      : file_(file, context), context_(context), images_(file_, context), own_(own_frame(file_.root())) {
    geometry_.path = file->path();
  }

  RawGeometry read() {
    refuse_gltf_extensions(file_);
    for (const auto& placement : gltf_placements(file_, context_)) {
      context_.check_cancelled();
      add(placement);
    }
    if (lines_ > 0)
      context_.warn(
          fmt::format("{}: {}: not read", path(), counted(lines_, "primitive is of lines", "primitives are of lines")));
    if (empty_ > 0)
      context_.warn(
          fmt::format("{}: {} no POSITION: not read", path(), counted(empty_, "primitive has", "primitives have")));
    if (morphed_ > 0)
      context_.warn(
          fmt::format("{}: {} with morph targets: read without them", path(), counted(morphed_, "primitive")));
    finish_faces();
    finish_vertices();
    return std::move(geometry_);
  }

 private:
  const std::string& path() const { return geometry_.path; }

  void add(const GltfPlacement& placement) {
    Eigen::Affine3d to_file = placement.to_scene;
    if (own_) to_file = *own_ * to_file;
    shared_.clear();
    const JsonField primitives = placement.mesh["primitives"];
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      const JsonField primitive = primitives.at(p);
      const std::uint64_t mode = primitive.natural("mode", mode_triangles);
      if (mode > mode_fan) primitive["mode"].fail("is none of glTF's: 0 to 6");
      if (mode >= mode_lines && mode < mode_triangles) {
        ++lines_;
      } else if (!primitive["attributes"].has("POSITION")) {
        ++empty_;
      } else {
        morphed_ += primitive.has("targets") ? 1 : 0;
        const auto [first, count] = vertices_of(primitive, to_file);
        if (mode == mode_points)
          points_ += count;
        else
          add_faces(primitive, mode, first, count, to_file.linear().determinant() < 0);
      }
    }
  }

  /// Where the primitive's vertices begin, and how many there are. Primitives of a mesh may share them.
  std::pair<std::size_t, std::size_t> vertices_of(const JsonField& primitive, const Eigen::Affine3d& to_file) {
    constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();
    const JsonField attributes = primitive["attributes"];
    const std::array<std::uint64_t, 4> key{attributes.natural("POSITION"), attributes.natural("NORMAL", none),
                                           attributes.natural("COLOR_0", none), primitive.natural("material", none)};
    const auto known = shared_.find(key);
    if (known != shared_.end()) return known->second;
    const GltfShape shape = gltf_shape(file_, attributes, "POSITION");
    if (shape.width != 3 || shape.type == Scalar::u32)
      attributes["POSITION"].fail("names an accessor that is not of three coordinates");
    const std::size_t first = vertices_.places.size();
    check_room(first + shape.count, attributes["POSITION"]);
    add_places(gltf_numbers(file_, attributes, "POSITION"), to_file);
    add_normals(attributes, first, shape.count, to_file.linear());
    auto colours = gltf_colours(file_, images_, primitive, shape.count, !own_);
    if (!colours.empty()) {
      vertices_.colours.resize(first, {255, 255, 255});
      vertices_.colours.insert(vertices_.colours.end(), colours.begin(), colours.end());
    }
    return shared_[key] = {first, shape.count};
  }

  /// Nodes may repeat a mesh, so that a small file stands for many vertices.
  void check_room(std::size_t vertices, const JsonField& from) const {
    constexpr std::size_t of_byte = 100;
    if (vertices > of_byte * file_.bytes() || vertices >= std::numeric_limits<std::uint32_t>::max())
      from.fail(fmt::format("adds to {} vertices, by nodes that repeat a mesh: more than {} a byte of the file",
                            vertices, of_byte),
                "export what the nodes repeat as meshes of their own");
  }

  void add_places(const GltfNumbers& numbers, const Eigen::Affine3d& to_file) {
    for (std::size_t i = 0; i < numbers.count; ++i) {
      const float* p = numbers.row(i);
      const Eigen::Vector3d local(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]));
      vertices_.places.emplace_back(to_file * local);
      largest_local_ = std::max(largest_local_, local.cwiseAbs().maxCoeff());
      largest_ = std::max(largest_, vertices_.places.back().cwiseAbs().maxCoeff());
    }
  }

  void add_normals(const JsonField& attributes, std::size_t first, std::size_t count, const Eigen::Matrix3d& turn) {
    if (!attributes.has("NORMAL") || vertices_.normals.size() != first) return;  // all have one, or none
    const GltfNumbers numbers = gltf_numbers(file_, attributes, "NORMAL");
    if (numbers.width != 3 || numbers.count != count)
      attributes["NORMAL"].fail(
          fmt::format("has {} vectors of {} numbers, but there are {} vertices", numbers.count, numbers.width, count));
    Eigen::Matrix3d cofactors;
    cofactors << turn.col(1).cross(turn.col(2)), turn.col(2).cross(turn.col(0)), turn.col(0).cross(turn.col(1));
    if (turn.determinant() < 0) cofactors = -cofactors;
    for (std::size_t i = 0; i < count; ++i) {
      const float* n = numbers.row(i);
      vertices_.normals.emplace_back(
          (cofactors * Eigen::Vector3f(n[0], n[1], n[2]).cast<double>()).normalized().cast<float>());
    }
  }

  void add_faces(const JsonField& primitive, std::uint64_t mode, std::size_t first, std::size_t count, bool mirrored) {
    std::vector<std::uint32_t> corners;
    if (primitive.has("indices")) {
      check_room((faces_.triangles.size() + gltf_shape(file_, primitive, "indices").count) / 3, primitive["indices"]);
      corners = gltf_indices(file_, primitive, "indices", count);
    } else {
      corners.resize(count);
      for (std::size_t i = 0; i < count; ++i) corners[i] = static_cast<std::uint32_t>(i);
    }
    for (auto& c : corners) c += static_cast<std::uint32_t>(first);
    const std::size_t before = faces_.triangles.size();
    const std::array<bool, 3> has{own_.has_value(), own_.has_value(), own_.has_value()};
    const auto values = own_ ? attributes_of(primitive) : std::array<std::int32_t, 3>{};
    if (mode == mode_strip) {
      faces_.add_strips(corners, has, values);
    } else if (mode == mode_fan) {
      for (std::size_t k = 2; k < corners.size(); ++k)
        faces_.add({corners[0], corners[k - 1], corners[k]}, has, values);
    } else {
      if (corners.size() % 3 != 0) ++faces_.skipped;
      for (std::size_t k = 2; k < corners.size(); k += 3)
        faces_.add({corners[k - 2], corners[k - 1], corners[k]}, has, values);
    }
    for (std::size_t t = before; mirrored && t < faces_.triangles.size(); ++t)
      std::swap(faces_.triangles[t][1], faces_.triangles[t][2]);
  }

  /// Class, storey and primitive as io.write_mesh writes them.
  static std::array<std::int32_t, 3> attributes_of(const JsonField& primitive) {
    std::array<std::int32_t, 3> values{0, -1, -1};
    if (!primitive.has("extras")) return values;
    const JsonField extras = primitive["extras"];
    constexpr std::int32_t most = std::numeric_limits<std::int32_t>::max();
    if (extras.has("storey")) values[1] = extras["storey"].whole(-1, most);
    if (extras.has("primitive")) values[2] = extras["primitive"].whole(-1, most);
    if (!extras.has("class")) return values;
    const std::string name = extras["class"].text();
    for (const SurfaceClass c : all_classes)
      if (name == name_of(c)) values[0] = static_cast<std::int32_t>(c);
    return values;
  }

  void finish_faces() {
    std::vector<FaceList> one;
    one.push_back(std::move(faces_));
    FaceList::join(one, geometry_);
    const auto drop = [](std::vector<std::int32_t>& column, std::int32_t nothing) {
      if (std::all_of(column.begin(), column.end(), [&](std::int32_t v) { return v == nothing; })) column.clear();
    };
    drop(geometry_.storeys, -1);
    drop(geometry_.primitives, -1);
    if (geometry_.primitives.empty()) drop(geometry_.classes, 0);
    if (points_ > 0 && !geometry_.triangles.empty())
      context_.warn(
          fmt::format("{}: {} of {} vertices are points without faces", path(), points_, vertices_.places.size()));
  }

  void weld() {
    const auto first = first_at_same_place(vertices_.places);
    std::vector<std::uint32_t> place(first.size()), kept;
    for (std::uint32_t i = 0; i < first.size(); ++i) {
      place[i] = first[i] == i ? static_cast<std::uint32_t>(kept.size()) : place[first[i]];
      if (first[i] == i) kept.push_back(i);
    }
    take(vertices_.places, kept);
    take(vertices_.normals, kept);
    take(vertices_.colours, kept);
    for (auto& triangle : geometry_.triangles)
      for (auto& corner : triangle) corner = place[corner];
  }

  void finish_vertices() {
    if (!vertices_.colours.empty()) vertices_.colours.resize(vertices_.places.size(), {255, 255, 255});
    if (vertices_.normals.size() != vertices_.places.size()) vertices_.normals = {};
    if (!geometry_.triangles.empty()) weld();
    geometry_.count = vertices_.places.size();
    geometry_.y_up = !own_;
    if (own_) geometry_.metres_per_unit = 1.0;
    geometry_.float_table = largest_local_ > largest_ / 2;  // else nodes put what is near zero there
    if (geometry_.count == 0) return;
    const auto kept = std::make_shared<const Vertices>(std::move(vertices_));
    const auto columns = [&](const auto& rows, std::array<Role, 3> roles, Scalar type) {
      for (std::size_t a = 0; a < 3 && !rows.empty(); ++a)
        geometry_.column(roles[a]) = {reinterpret_cast<const std::byte*>(rows.data()) + a * size_of(type),
                                      sizeof(rows[0]), type};
    };
    columns(kept->places, {Role::x, Role::y, Role::z}, Scalar::f64);
    columns(kept->normals, {Role::nx, Role::ny, Role::nz}, Scalar::f32);
    columns(kept->colours, {Role::red, Role::green, Role::blue}, Scalar::u8);
    geometry_.storage.push_back(kept);
  }

  GltfFile file_;
  const Context& context_;
  GltfImages images_;
  std::optional<Eigen::Affine3d> own_;  ///< of a file of io.write_mesh: to true coordinates
  RawGeometry geometry_;
  Vertices vertices_;
  FaceList faces_;
  std::map<std::array<std::uint64_t, 4>, std::pair<std::size_t, std::size_t>> shared_;  ///< of the mesh at hand
  double largest_local_ = 0, largest_ = 0;
  std::size_t points_ = 0, lines_ = 0, empty_ = 0, morphed_ = 0;
};

}  // namespace

RawGeometry read_gltf(const std::shared_ptr<const MappedFile>& file, const Context& context) {
  return GltfReader(file, context).read();
}

}  // namespace atrium::io
