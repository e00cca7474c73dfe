#include "modules/scene/view_cells.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "graph/api/random.hpp"

namespace atrium::scene::view_cells_test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

Vector3d any_place(Random& random, double reach) {
  return Vector3d(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5) * (2 * reach);
}

/// An image at any place and attitude.
FaceTexture any_image(Random& random, double reach) {
  FaceTexture image;
  image.corner = any_place(random, reach);
  const Eigen::Quaterniond turn = Eigen::Quaterniond(Eigen::Vector4d(any_place(random, 1).homogeneous())).normalized();
  const double width = 0.02 + 6 * random.uniform(), height = 0.02 + 3 * random.uniform();
  image.width = std::max(1, static_cast<int>(width / 0.02));
  image.height = std::max(1, static_cast<int>(height / 0.02));
  image.across = turn * Vector3d(width, 0, 0);
  image.down = turn * Vector3d(0, 0, -height);
  return image;
}

/// Each point's images are among those of its cell: with a test of all of them as the measure.
void check(const std::vector<TextureView>& views, const Cloud& cloud, std::size_t least_found) {
  const ViewCells cells(views, Context{});
  std::size_t found = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto near = cells.views_at(cloud.points[i]);
    EXPECT_TRUE(std::is_sorted(near.begin(), near.end()));
    for (std::uint32_t v = 0; v < views.size(); ++v) {
      if (!is_over(views[v], cloud, i)) continue;
      ++found;
      EXPECT_TRUE(std::binary_search(near.begin(), near.end(), v)) << "point " << i << ", image " << v;
    }
  }
  EXPECT_GE(found, least_found);
}

void check_scene(double reach, double shift) {
  Random random(7);
  Cloud cloud;
  std::vector<TextureView> views;
  for (int v = 0; v < 30; ++v) {
    const FaceTexture image = any_image(random, reach);
    for (int i = 0; i < 400; ++i) {  // also over the image's borders
      const double s = 1.1 * random.uniform() - 0.05, t = 1.1 * random.uniform() - 0.05;
      const Vector3d n = image.down.cross(image.across).normalized();
      const Vector3d p = image.corner + s * image.across + t * image.down + (0.4 * random.uniform() - 0.1) * n;
      cloud.points.emplace_back((p + Vector3d::Constant(shift)).cast<float>());
    }
    views.emplace_back(image, Vector3d::Constant(-shift), cloud, 0.05);
  }
  for (int i = 0; i < 100; ++i) cloud.points.emplace_back(any_place(random, 1e6).cast<float>());
  cloud.points.emplace_back(Vector3f::Constant(std::numeric_limits<float>::max()));
  check(views, cloud, 3000);
}

TEST(ViewCells, LoseNoPointOverAnImage) { check_scene(5, 0); }
TEST(ViewCells, LoseNoPointOverAnImageFarFromTheOrigin) { check_scene(5, 1000); }
TEST(ViewCells, LoseNoPointOverImagesFarApart) { check_scene(5000, 0); }

TEST(ViewCells, LeaveOutWhatIsFarAway) {
  FaceTexture image;
  image.across = {4, 0, 0};
  image.down = {0, 0, -2};
  image.width = 40;
  image.height = 20;
  const ViewCells cells({TextureView(image, Vector3d::Zero(), Cloud{}, 0.05)}, Context{});
  EXPECT_EQ(cells.views_at({2, 0, -1}).size(), 1U);
  EXPECT_TRUE(cells.views_at({2, 3, -1}).empty());
  EXPECT_TRUE(cells.views_at({7, 0, -1}).empty());
  EXPECT_TRUE(cells.views_at({2, 0, 3e38F}).empty());
}

TEST(ViewCells, NoImages) {
  const ViewCells cells({}, Context{});
  EXPECT_TRUE(cells.views_at({0, 0, 0}).empty());
}

}  // namespace
}  // namespace atrium::scene::view_cells_test
