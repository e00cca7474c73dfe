#include "modules/io/glb_cloud_writer.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "graph/api/error.hpp"
#include "modules/geometry/quantile.hpp"
#include "modules/io/byte_buffer.hpp"
#include "modules/io/glb_groups.hpp"

namespace atrium::io {
namespace {

using Colour16 = std::array<std::uint16_t, 4>;

constexpr double first_edge = 64;        // metres
constexpr std::size_t most_tiles = 512;  // a cloud with wild points has larger tiles instead
constexpr double finest = 0.001;         // metres: noise below would take most of the file when it is compressed
constexpr double most_steps = 65535;
constexpr std::size_t row = 8;  // bytes of a place, and of a colour: three numbers and what aligns the next

struct Tile {
  std::vector<std::uint32_t> points;
  Eigen::AlignedBox3d box;

  Eigen::Array3d step() const { return (box.sizes().array() / most_steps).max(finest); }
  Eigen::Array3d steps(const Eigen::Vector3d& at) const { return ((at - box.min()).array() / step()).round(); }
};
using Tiles = std::map<std::array<std::int64_t, 3>, Tile>;

/// The points that are written, in glTF's frame.
class GlbPoints {
 public:
  GlbPoints(const Cloud& cloud, const std::vector<std::uint32_t>& points, const Eigen::Vector3d& up)
      : cloud_(cloud), points_(points), turn_(glb_rotation(up)) {
    Eigen::AlignedBox3d box;
    for (const auto i : points) {
      if (!cloud.points[i].allFinite()) throw Error(fmt::format("point {} of the cloud is not finite", i));
      box.extend(cloud.points[i].cast<double>());
    }
    offset_ = glb_offset(cloud.origin, box);
    find_greys();
    for (double edge = first_edge; tiles_.empty() && !box.isEmpty(); edge *= 2) cut(edge);
  }

  void write(AtomicFile& file) const {
    std::size_t count = 0;
    for (const auto& [key, tile] : tiles_) count += tile.points.size();
    const std::size_t bytes = count * row * (has_colours() ? 2 : 1);
    std::string json = description(count, bytes);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::size_t whole = 12 + 8 + json.size() + (bytes > 0 ? 8 + bytes : 0);
    if (whole > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
      throw Error(fmt::format("{} points are larger than the 2 GiB that a .glb file can have here", count),
                  "set `max_points`, or write the cloud as .ply");
    ByteBuffer out(file);
    out.text("glTF");
    for (const std::size_t n : {std::size_t{2}, whole, json.size()}) out.number(static_cast<std::uint32_t>(n));
    out.text("JSON");
    out.text(json);
    if (bytes > 0) {
      out.number(static_cast<std::uint32_t>(bytes));
      out.text(std::string_view("BIN\0", 4));
      for (const auto& [key, tile] : tiles_) write_places(tile, out);
      if (has_colours())
        for (const auto& [key, tile] : tiles_) write_colours(tile, out);
    }
    out.flush();
  }

 private:
  bool has_colours() const { return !cloud_.colours.empty() || !cloud_.intensities.empty(); }

  Eigen::Vector3d place(std::size_t i) const {
    return turn_ * (cloud_.origin - offset_ + cloud_.points[i].cast<double>());
  }

  void cut(double edge) {
    for (const auto i : points_) {
      const Eigen::Vector3d at = place(i);
      constexpr double farthest = 1e15;  // cells: integers hold them
      const Eigen::Array3d cell = (at.array() / edge).floor().max(-farthest).min(farthest);
      Tile& tile = tiles_[{static_cast<std::int64_t>(cell.x()), static_cast<std::int64_t>(cell.y()),
                           static_cast<std::int64_t>(cell.z())}];
      tile.points.push_back(i);
      tile.box.extend(at);
      if (tiles_.size() > most_tiles) {
        tiles_.clear();
        return;
      }
    }
  }

  /// Between which intensities greys go from black to white: all but the 2 % at both ends.
  void find_greys() {
    if (!cloud_.colours.empty() || cloud_.intensities.empty()) return;
    std::vector<float> values;
    values.reserve(points_.size());
    for (const auto i : points_)
      if (std::isfinite(cloud_.intensities[i])) values.push_back(cloud_.intensities[i]);
    if (values.empty()) return;
    dark_ = quantile(values, 0.02);
    light_ = std::max(quantile(std::move(values), 0.98), std::nextafter(dark_, std::numeric_limits<float>::max()));
  }
  Colour colour(std::size_t i) const {
    if (!cloud_.colours.empty()) return cloud_.colours[i];
    const float value = std::isfinite(cloud_.intensities[i]) ? cloud_.intensities[i] : dark_;
    const float grey = std::clamp((value - dark_) / (light_ - dark_), 0.0F, 1.0F);
    const auto level = static_cast<std::uint8_t>(std::lround(30 + 215 * grey));
    return {level, level, level};
  }

  void write_places(const Tile& tile, ByteBuffer& out) const {
    for (const auto i : tile.points) {
      const Eigen::Array3d steps = tile.steps(place(i));
      for (int a = 0; a < 3; ++a) out.number(static_cast<std::uint16_t>(steps[a]));
      out.number(std::uint16_t{0});
    }
  }
  void write_colours(const Tile& tile, ByteBuffer& out) const {
    for (const auto i : tile.points) {
      const Colour16 linear = linear16(colour(i));
      for (std::size_t c = 0; c < 3; ++c) out.number(linear.at(c));
      out.number(std::uint16_t{0});
    }
  }

  /// The file's JSON.
  std::string description(std::size_t count, std::size_t bytes) const {
    std::string nodes, meshes, accessors, roots;
    std::size_t n = 0, from = 0;
    for (const auto& [key, tile] : tiles_) {
      const char* comma = n == 0 ? "" : ",";
      const Eigen::Array3d scale = most_steps * tile.step(), top = tile.steps(tile.box.max());
      const Eigen::Vector3d low = tile.box.min();
      roots += fmt::format("{}{}", comma, n);
      nodes += fmt::format(R"({}{{"mesh":{},"translation":[{},{},{}],"scale":[{},{},{}]}})", comma, n, low.x(), low.y(),
                           low.z(), scale.x(), scale.y(), scale.z());
      const std::size_t places = has_colours() ? 2 * n : n;
      meshes += fmt::format(R"({}{{"primitives":[{{"mode":0,"material":0,"attributes":{{"POSITION":{}{}}}}}]}})", comma,
                            places, has_colours() ? fmt::format(R"(,"COLOR_0":{})", places + 1) : "");
      const auto accessor = [&, points = tile.points.size()](int view, const std::string& more) {
        accessors += fmt::format(
            R"({}{{"bufferView":{},"byteOffset":{},"componentType":5123,"normalized":true,"type":"VEC3","count":{}{}}})",
            accessors.empty() ? "" : ",", view, from, points, more);
      };
      accessor(0, fmt::format(R"(,"min":[0,0,0],"max":[{},{},{}])", top[0], top[1], top[2]));
      if (has_colours()) accessor(1, "");
      from += tile.points.size() * row;
      ++n;
    }
    std::string json = fmt::format(
        R"({{"asset":{{"version":"2.0","generator":"Atrium","extras":{}}},"scene":0,"scenes":[{{"name":"Atrium"{}}}])",
        extras(), roots.empty() ? "" : fmt::format(R"(,"nodes":[{}])", roots));
    if (n == 0) return json + "}";
    const std::size_t half = count * row;
    std::string views = fmt::format(R"({{"buffer":0,"byteLength":{},"byteStride":8,"target":34962}})", half);
    if (has_colours())
      views += fmt::format(R"(,{{"buffer":0,"byteOffset":{0},"byteLength":{0},"byteStride":8,"target":34962}})", half);
    return json +
           fmt::format(
               R"(,"extensionsUsed":["KHR_materials_unlit","KHR_mesh_quantization"],"extensionsRequired":["KHR_mesh_quantization"],"materials":[{{"name":"points","pbrMetallicRoughness":{{"metallicFactor":0}},"extensions":{{"KHR_materials_unlit":{{}}}}}}],"nodes":[{}],"meshes":[{}],"accessors":[{}],"bufferViews":[{}],"buffers":[{{"byteLength":{}}}]}})",
               nodes, meshes, accessors, views, bytes);
  }

  /// How true coordinates follow, as in the files of meshes: a matrix, column after column.
  std::string extras() const {
    std::string matrix;
    for (int c = 0; c < 4; ++c)
      for (int r = 0; r < 4; ++r)
        matrix += fmt::format("{}{}", matrix.empty() ? "" : ",",
                              c == 3 ? (r == 3 ? 1.0 : offset_[r]) : (r == 3 ? 0.0 : turn_(c, r)));
    return fmt::format(R"({{"origin":[{},{},{}],"unit":"metre","to_true":[{}]}})", offset_.x(), offset_.y(),
                       offset_.z(), matrix);
  }

  const Cloud& cloud_;
  const std::vector<std::uint32_t>& points_;
  Eigen::Matrix3d turn_;  ///< from the cloud's frame to glTF's
  Eigen::Vector3d offset_ = Eigen::Vector3d::Zero();
  Tiles tiles_;
  float dark_ = 0, light_ = 1;
};

}  // namespace

void write_glb(const Cloud& cloud, const std::vector<std::uint32_t>& points, const Eigen::Vector3d& up,
               AtomicFile& file) {
  GlbPoints(cloud, points, up).write(file);
}

}  // namespace atrium::io
