#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/scene/texture_painting.hpp"

namespace atrium::scene {

/// Which images a point can lie over at all: a table over cubic cells of half a metre (larger ones where the images
/// are far apart), so that a point is tested against the few images near it and not against all of a building's.
class ViewCells {
 public:
  ViewCells(const std::vector<TextureView>& views, const Context& context);

  /// The numbers of the images, ascending: all that the point lies over (is_over), and some others.
  std::span<const std::uint32_t> views_at(const Eigen::Vector3f& p) const {
    const Eigen::Vector3f at = (p - low_) * inverse_;
    if (!(at.x() >= 0 && at.y() >= 0 && at.z() >= 0 && at.x() < extent_.x() && at.y() < extent_.y() &&
          at.z() < extent_.z()))
      return {};
    const std::size_t cell =
        index(static_cast<std::size_t>(at.x()), static_cast<std::size_t>(at.y()), static_cast<std::size_t>(at.z()));
    return {views_.data() + begin_[cell], begin_[cell + 1] - begin_[cell]};
  }

 private:
  std::size_t index(std::size_t x, std::size_t y, std::size_t z) const { return (z * number_[1] + y) * number_[0] + x; }
  void span(const std::vector<TextureView>& views);
  /// The cells that hold places over an image.
  std::vector<std::uint32_t> cells_of(const TextureView& view) const;

  Eigen::Vector3f low_ = Eigen::Vector3f::Zero(), extent_ = Eigen::Vector3f::Zero();  // the extent in cells
  float edge_ = 1, inverse_ = 1;
  std::array<std::size_t, 3> number_{0, 0, 0};  // of cells along each axis
  std::vector<std::uint32_t> begin_, views_;    // of cell c: views_[begin_[c]] … views_[begin_[c + 1] - 1]
};

}  // namespace atrium::scene
