#include "modules/scene/texture_painting.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "modules/geometry/quantile.hpp"
#include "modules/scene/pull_push.hpp"

namespace atrium::scene {
namespace {

constexpr float reaches = 5.0F;         // how far in front points hide the plane, in distances
constexpr float layer_share = 0.25F;    // standard deviation of a layer's thickness, in distances
constexpr float tile_size = 0.04F;      // over which a layer is level, metres
constexpr float least_cosine = 0.5F;    // of a point's normal to the plane's
constexpr float least_support = 4;      // neighbours in the layer that a point needs to be believed
constexpr float support_share = 0.05F;  // and as a share of what is usual on this plane
constexpr float visible_share = 0.33F;  // a pixel with less of its points in the layer is covered

/// Height of the layer that is nearest to the plane, over square tiles.
class Layers {
 public:
  Layers(const TextureView& view, const Cloud& cloud, const std::vector<std::uint32_t>& points)
      : pixels_(std::max(1, static_cast<int>(std::lround(tile_size * view.across.norm())))),
        columns_((view.width + pixels_ - 1) / pixels_),
        heights_(static_cast<std::size_t>(columns_) * ((view.tall + pixels_ - 1) / pixels_)),
        factor_(-0.5F / (layer_share * layer_share * view.distance * view.distance)) {
    std::vector<float> weights(heights_.size());
    for (const auto i : points) {
      const Eigen::Vector3f& p = cloud.points[i];
      const float height = view.height(p);
      if (height > view.distance) continue;
      const float weight = std::exp(height * height * factor_);
      const std::size_t t = tile(view.column(p), view.row(p));
      heights_[t] += weight * height;
      weights[t] += weight;
    }
    for (std::size_t t = 0; t < weights.size(); ++t)
      if (weights[t] > 0) heights_[t] /= weights[t];
  }
  std::size_t tile(float column, float row) const {
    return static_cast<std::size_t>(static_cast<int>(row) / pixels_) * columns_ + static_cast<int>(column) / pixels_;
  }
  std::size_t tiles() const { return heights_.size(); }
  int columns() const { return columns_; }
  /// 1 for a point in the layer, towards 0 away from it.
  float share(float height, float column, float row) const {
    const float above = height - heights_[tile(column, row)];
    return std::exp(above * above * factor_);
  }

 private:
  int pixels_, columns_;
  std::vector<float> heights_;
  float factor_;
};

/// Calls add(pixel, weight) for the four pixels around a place; weights add up to 1.
template <class Add>
void splat(const TextureView& view, float column, float row, Add add) {
  const float x = column - 0.5F, y = row - 0.5F;
  const float left = std::floor(x), top = std::floor(y);
  const float right_share = x - left, low_share = y - top;
  const int u0 = std::max(0, static_cast<int>(left)), u1 = std::min(view.width - 1, static_cast<int>(left) + 1);
  const int v0 = std::max(0, static_cast<int>(top)), v1 = std::min(view.tall - 1, static_cast<int>(top) + 1);
  const auto index = [&](int u, int v) { return static_cast<std::size_t>(v) * view.width + u; };
  add(index(u0, v0), (1 - right_share) * (1 - low_share));
  add(index(u1, v0), right_share * (1 - low_share));
  add(index(u0, v1), (1 - right_share) * low_share);
  add(index(u1, v1), right_share * low_share);
}

/// Sums over each cell of a grid and its eight neighbours.
std::vector<float> around(const std::vector<float>& values, int columns) {
  const int rows = static_cast<int>(values.size()) / columns;
  const auto add_neighbours = [&](const std::vector<float>& from, int step, bool along_rows) {
    std::vector<float> to = from;
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x) {
        const int place = along_rows ? x : y, end = along_rows ? columns : rows;
        const std::size_t i = static_cast<std::size_t>(y) * columns + x;
        if (place > 0) to[i] += from[i - step];
        if (place + 1 < end) to[i] += from[i + step];
      }
    return to;
  };
  return add_neighbours(add_neighbours(values, 1, true), columns, false);
}

/// How many neighbours make points believed: few where the whole plane is sparse.
float support_of(std::vector<float> near) {
  near.erase(std::remove_if(near.begin(), near.end(), [](float n) { return n < 1; }), near.end());
  if (near.empty()) return least_support;
  return std::max(least_support, support_share * median(std::move(near)));
}

/// Sums become means. A pixel is doubted where the plane is covered and where it has few neighbours.
void normalise(WeightedImage& image, const std::vector<float>& all, const Layers& layers,
               const std::vector<float>& near) {
  std::vector<float> in_layer;
  in_layer.reserve(image.pixels.size());
  for (const auto& pixel : image.pixels) in_layer.push_back(pixel[3]);
  const auto layer_around = around(in_layer, image.width), all_around = around(all, image.width);
  const float support = support_of(near);
  image.confidence.resize(image.pixels.size());
  std::size_t i = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x, ++i) {
      WeightedColour& pixel = image.pixels[i];
      const float sum = pixel[3];
      if (!(sum > 0)) continue;
      pixel /= sum;
      pixel[3] = std::min(sum, 1.0F);
      const float visible = std::min(1.0F, layer_around[i] / (visible_share * all_around[i]));
      const float others = std::max(0.0F, near[layers.tile(static_cast<float>(x), static_cast<float>(y))] - 1);
      const float supported = std::min(1.0F, others / support);
      image.confidence[i] = std::max(1e-6F, visible * visible * visible * supported * supported);
    }
}

}  // namespace

TextureView::TextureView(const FaceTexture& image, const Eigen::Vector3d& shift, const Cloud& cloud,
                         double max_distance)
    : distance(static_cast<float>(max_distance)), reach(reaches * distance), width(image.width), tall(image.height) {
  const Eigen::Vector3d n = image.down.cross(image.across).normalized();
  const Eigen::Vector3d u = image.across * (image.width / image.across.squaredNorm());
  const Eigen::Vector3d v = image.down * (image.height / image.down.squaredNorm());
  const Eigen::Vector3d from = shift - image.corner;
  normal = n.cast<float>();
  across = u.cast<float>();
  down = v.cast<float>();
  offset = static_cast<float>(n.dot(from));
  left = static_cast<float>(u.dot(from));
  top = static_cast<float>(v.dot(from));
  if (!cloud.has_normals() && (cloud.sensors.size() == 1 || !cloud.source.empty()))
    for (const auto& sensor : cloud.sensors) seen.push_back(height(sensor) > 0);
}

bool is_over(const TextureView& view, const Cloud& cloud, std::size_t point) {
  const Eigen::Vector3f& p = cloud.points[point];
  const float height = view.height(p);
  if (!(height >= -view.distance && height <= view.reach)) return false;
  const float x = view.column(p), y = view.row(p);
  if (!(x >= 0 && x < static_cast<float>(view.width) && y >= 0 && y < static_cast<float>(view.tall))) return false;
  if (!view.seen.empty() && !view.seen[cloud.source.empty() ? 0 : cloud.source[point]]) return false;
  return height > view.distance || !cloud.has_normals() || cloud.normals[point].dot(view.normal) >= least_cosine;
}

bool paint(const TextureView& view, const Cloud& cloud, const std::vector<std::uint32_t>& points, FaceTexture& image) {
  WeightedImage sums;
  sums.width = view.width;
  sums.height = view.tall;
  sums.pixels.assign(static_cast<std::size_t>(view.width) * view.tall, WeightedColour::Zero());
  std::vector<float> all(sums.pixels.size());
  const Layers layers(view, cloud, points);
  std::vector<float> in_layer(layers.tiles());
  bool coloured = false;
  for (const auto i : points) {
    const Eigen::Vector3f& p = cloud.points[i];
    const float height = view.height(p), column = view.column(p), row = view.row(p);
    const float share = height <= view.distance ? layers.share(height, column, row) : 0;
    const auto& [red, green, blue] = cloud.colours[i];
    const WeightedColour colour(red, green, blue, 1);
    splat(view, column, row, [&](std::size_t pixel, float weight) {
      all[pixel] += weight;
      sums.pixels[pixel] += colour * (share * weight);
    });
    in_layer[layers.tile(column, row)] += share;
    coloured = coloured || share > 0;
  }
  if (!coloured) return false;
  normalise(sums, all, layers, around(in_layer, layers.columns()));
  pull_push(sums);
  image.pixels.reserve(sums.pixels.size() * 3);
  for (const auto& pixel : sums.pixels)
    for (int c = 0; c < 3; ++c)
      image.pixels.push_back(static_cast<std::uint8_t>(std::clamp(pixel[c] + 0.5F, 0.0F, 255.0F)));
  return true;
}

}  // namespace atrium::scene
