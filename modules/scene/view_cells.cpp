#include "modules/scene/view_cells.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace atrium::scene {
namespace {

constexpr float least_edge = 0.5F;             // metres
constexpr double most_cells = 1U << 20U;       // more are left out by larger cells
constexpr float slack = 0.01F;                 // of a cell's edge: rounding never loses a point
constexpr std::size_t most_along_axis = 1024;  // a coordinate in cells keeps more digits than that slack

/// Whether any place in the box can lie over the image (a test of intervals, so some others pass, too).
bool may_be_over(const TextureView& view, const Eigen::AlignedBox3f& box) {
  const Eigen::Vector3f centre = box.center(), half = box.sizes() / 2;
  const auto meets = [&](float value, const Eigen::Vector3f& axis, float low, float high) {
    const float reach = axis.cwiseAbs().dot(half) * 1.001F + 1e-3F * (high - low);
    return value + reach >= low && value - reach <= high;
  };
  return meets(view.height(centre), view.normal, -view.distance, view.reach) &&
         meets(view.column(centre), view.across, 0, static_cast<float>(view.width)) &&
         meets(view.row(centre), view.down, 0, static_cast<float>(view.tall));
}

/// All places over an image, in the points' frame.
Eigen::AlignedBox3f places_over(const TextureView& view) {
  Eigen::Matrix3f axes;
  axes << view.across.transpose(), view.down.transpose(), view.normal.transpose();
  const Eigen::Matrix3f back = axes.inverse();
  Eigen::AlignedBox3f box;
  for (const float column : {0.0F, static_cast<float>(view.width)})
    for (const float row : {0.0F, static_cast<float>(view.tall)})
      for (const float height : {-view.distance, view.reach})
        box.extend(back * Eigen::Vector3f(column - view.left, row - view.top, height - view.offset));
  return box;
}

}  // namespace

void ViewCells::span(const std::vector<TextureView>& views) {
  Eigen::AlignedBox3f box;
  for (const auto& view : views) box.extend(places_over(view));
  const Eigen::Vector3d size = box.sizes().cast<double>();
  double edge = std::max<double>(least_edge, size.maxCoeff() / (most_along_axis - 2));
  const auto cells = [&] { return ((size / edge).array() + 2).prod(); };
  while (cells() > most_cells) edge *= 1.25;
  edge_ = static_cast<float>(edge);
  inverse_ = 1 / edge_;
  low_ = box.min() - Eigen::Vector3f::Constant(edge_ / 2);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    number_[axis] = static_cast<std::size_t>(std::ceil(size[static_cast<Eigen::Index>(axis)] / edge)) + 1;
    extent_[static_cast<Eigen::Index>(axis)] = static_cast<float>(number_[axis]);
  }
}

std::vector<std::uint32_t> ViewCells::cells_of(const TextureView& view) const {
  const Eigen::AlignedBox3f box = places_over(view);
  std::array<std::size_t, 3> first{}, last{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    const auto place = [&](float at) {
      return std::clamp((at - low_[a]) * inverse_, 0.0F, static_cast<float>(number_[axis] - 1));
    };
    first[axis] = static_cast<std::size_t>(place(box.min()[a] - slack * edge_));
    last[axis] = static_cast<std::size_t>(place(box.max()[a] + slack * edge_));
  }
  std::vector<std::uint32_t> cells;
  for (std::size_t z = first[2]; z <= last[2]; ++z)
    for (std::size_t y = first[1]; y <= last[1]; ++y)
      for (std::size_t x = first[0]; x <= last[0]; ++x) {
        const Eigen::Vector3f corner = low_ + edge_ * Eigen::Vector3d(x, y, z).cast<float>();
        const Eigen::AlignedBox3f cell(corner - Eigen::Vector3f::Constant(slack * edge_),
                                       corner + Eigen::Vector3f::Constant((1 + slack) * edge_));
        if (may_be_over(view, cell)) cells.push_back(static_cast<std::uint32_t>(index(x, y, z)));
      }
  return cells;
}

ViewCells::ViewCells(const std::vector<TextureView>& views, const Context& context) {
  if (views.empty()) return;
  span(views);
  std::vector<std::vector<std::uint32_t>> cells(views.size());
  context.parallel_for(
      views.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) cells[v] = cells_of(views[v]);
      },
      1);
  begin_.assign(number_[0] * number_[1] * number_[2] + 1, 0);
  for (const auto& list : cells)
    for (const auto c : list) ++begin_[c + 1];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  views_.resize(begin_.back());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (std::uint32_t v = 0; v < views.size(); ++v)
    for (const auto c : cells[v]) views_[next[c]++] = v;
}

}  // namespace atrium::scene
