// Scenes that no one would build: whatever the primitives, there is an answer, and rooms are closed.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/support/rooms.hpp"
#include "tests/unit/layout/chain.hpp"

namespace atrium::layout::random_scenes_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using namespace atrium::test;
using Scene = atrium::test::Rooms;

/// Points that are there: all but those in a few random balls.
class Gaps {
 public:
  explicit Gaps(Random& random, double most) {
    for (std::uint64_t i = 0; i < random.index(5); ++i)
      balls_.push_back(
          {{random.uniform(-2, 12), random.uniform(-2, 12), random.uniform(0, 3)}, random.uniform(0, most)});
  }
  bool operator()(const Vector3d& p) const {
    for (const auto& [middle, radius] : balls_)
      if ((p - middle).norm() < radius) return false;
    return true;
  }

 private:
  std::vector<std::pair<Vector3d, double>> balls_;
};

/// Adds a rectangle of the scene's own frame, turned and with gaps.
struct Builder {
  Random random;
  Scene scene;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();

  explicit Builder(std::uint64_t seed) : random(seed) {
    scene.spacing = 0.1;
    scene.noise = random.uniform() < 0.5 ? 0 : random.uniform(0, 0.01);
    const double yaw = random.uniform() < 0.5 ? 0 : random.uniform(-3, 3);
    turn = Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix();
  }
  void add(const Vector3d& corner, const Vector3d& a, const Vector3d& b, const Vector3d& normal) {
    const Gaps gaps(random, 2);
    scene.add(turn * corner, turn * a, turn * b, turn * normal,
              [&](const Vector3d& p) { return gaps(turn.transpose() * p); });
  }
  void add_wall(const Vector2d& from, const Vector2d& to, double bottom, double top) {
    const Vector2d way = to - from;
    add({from.x(), from.y(), bottom}, {way.x(), way.y(), 0}, {0, 0, top - bottom}, {-way.y(), way.x(), 0});
  }
  void add_room(double x0, double y0, double x1, double y1, double bottom, double top) {
    if (random.uniform() < 0.9) add({x0, y0, bottom}, {x1 - x0, 0, 0}, {0, y1 - y0, 0}, {0, 0, 1});
    if (random.uniform() < 0.8) add({x0, y0, top}, {x1 - x0, 0, 0}, {0, y1 - y0, 0}, {0, 0, -1});
    const std::vector<Vector2d> corners{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
    for (std::size_t i = 0; i < 4; ++i)
      if (random.uniform() < 0.9) add_wall(corners[i], corners[(i + 1) % 4], bottom, top);
  }
};

PlanePrimitives random_scene(std::uint64_t seed) {
  Builder builder(seed);
  Random& random = builder.random;
  const auto storeys = 1 + random.index(2);
  for (std::uint64_t s = 0; s < storeys; ++s) {
    const double bottom = 2.8 * static_cast<double>(s) + random.uniform(0, 0.05),
                 top = bottom + random.uniform(2.2, 2.7);
    for (std::uint64_t r = 0; r < 1 + random.index(4); ++r) {
      const double x = random.uniform(0, 7), y = random.uniform(0, 7);
      builder.add_room(x, y, x + random.uniform(0.3, 5), y + random.uniform(0.3, 5), bottom, top);
    }
    // Walls in any direction, short and long, and a slanted ceiling.
    for (std::uint64_t w = 0; w < random.index(4); ++w) {
      const Vector2d from(random.uniform(0, 9), random.uniform(0, 9)), to(random.uniform(0, 9), random.uniform(0, 9));
      builder.add_wall(from, to, bottom, bottom + random.uniform(0.2, top - bottom));
    }
    if (random.uniform() < 0.4) {
      const double rise = random.uniform(-2, 2);
      builder.add({random.uniform(0, 4), 0, top}, {4, 0, rise}, {0, random.uniform(1, 6), 0}, {rise / 4, 0, -1});
    }
  }
  return builder.scene.planes();
}

class RandomScenes : public testing::TestWithParam<std::uint64_t> {};

// Ten scenes in each test.
TEST_P(RandomScenes, HaveClosedRooms) {
  std::size_t rooms = 0;
  for (std::uint64_t seed = 10 * GetParam(); seed < 10 * GetParam() + 10; ++seed) {
    const PlanePrimitives planes = random_scene(seed);
    try {
      const Layout layout = laid_out(planes);
      EXPECT_EQ(flaw(layout), "") << "scene " << seed;
      rooms += layout.building.rooms.size();
    } catch (const Error& e) {
      // Only for want of level planes, of anything around them, or of a room between them.
      const std::string text = e.what();
      EXPECT_TRUE(text.find("level") != std::string::npos || text.find("no walls") != std::string::npos ||
                  text.find("shows no room") != std::string::npos)
          << "scene " << seed << ": " << text;
    }
  }
  EXPECT_GT(rooms, 0U);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomScenes, testing::Range<std::uint64_t>(0, 20));

}  // namespace
}  // namespace atrium::layout::random_scenes_test
