#include "modules/normal/orient.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <Eigen/Geometry>

#include "tests/bench/box_flat.hpp"

namespace atrium::normal::orient_test {
namespace {

Cloud run(const Cloud& cloud, Towards towards) {
  Context context;
  Orient::Params params;
  params.towards = towards;
  return Orient::run({input(cloud)}, params, context).cloud;
}

Cloud scrambled(Cloud cloud) {
  Random random(7);
  for (auto& n : cloud.normals)
    if (random.uniform() < 0.5) n = -n;
  return cloud;
}

/// Share of the points of walls, floors and ceilings whose normal points to the wrong side. (The tables are too thin.)
double share_wrong(const Cloud& found, const Cloud& truth) {
  std::size_t wrong = 0, all = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Eigen::Vector3f& at = truth.points[i];
    const float x = at.x() > 5.06F ? at.x() - 5.12F : at.x(), y = at.y() > 4.06F ? at.y() - 4.12F : at.y();
    const bool inner = x > 0.9F && x < 4.6F && y > 0.9F && y < 3.6F && at.z() > 0.2F && at.z() < 2.1F;
    if (inner) continue;
    ++all;
    wrong += found.normals[i].dot(truth.normals[i]) < 0 ? 1 : 0;
  }
  return static_cast<double>(wrong) / static_cast<double>(all);
}

/// The points of a cloud for which `keep` holds.
template <class Keep>
Cloud where(const Cloud& cloud, const Keep& keep) {
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < cloud.size(); ++i)
    if (keep(i)) indices.push_back(i);
  return select(cloud, indices);
}

TEST(NormalOrient, EachFaceOfAThinWallTurnsIntoItsOwnRoom) {
  const Cloud flat = bench::box_flat(400000);
  EXPECT_LT(share_wrong(run(scrambled(flat), Towards::inside), flat), 1e-4);
}

TEST(NormalOrient, SceneOfAnyAttitudeDensityAndPlace) {
  for (const std::size_t count : {40000, 400000}) {
    Cloud flat = bench::box_flat(count, 0.004, 3);
    flat.origin = {500000, 5400000, 0};
    const Eigen::Matrix3f turn =
        (Eigen::AngleAxisf(0.4F, Eigen::Vector3f::UnitZ()) * Eigen::AngleAxisf(0.05F, Eigen::Vector3f::UnitX()))
            .toRotationMatrix();
    Cloud turned = scrambled(flat);
    for (auto& p : turned.points) p = turn * p;
    for (auto& n : turned.normals) n = turn * n;
    Cloud found = run(turned, Towards::inside);
    for (auto& n : found.normals) n = turn.transpose() * n;
    EXPECT_LT(share_wrong(found, flat), 1e-4) << count;
  }
}

TEST(NormalOrient, FloorsWithoutCeilingsAndCeilingsWithoutFloors) {
  const Cloud flat = bench::box_flat(400000);
  const Cloud open = where(flat, [&](std::uint32_t i) { return flat.points[i].z() < 2.4F; });
  EXPECT_LT(share_wrong(run(scrambled(open), Towards::inside), open), 1e-3);
  const Cloud upper = where(flat, [&](std::uint32_t i) { return flat.points[i].z() > 1.0F; });
  EXPECT_LT(share_wrong(run(scrambled(upper), Towards::inside), upper), 1e-3);
}

TEST(NormalOrient, SensorsDecideWhereThereAreAny) {
  Cloud flat = bench::box_flat(50000, 0);
  const auto expect_towards = [](const Cloud& cloud, auto sensor) {
    for (std::size_t i = 0; i < cloud.size(); ++i)
      ASSERT_GE(cloud.normals[i].dot(cloud.sensors[sensor(i)] - cloud.points[i]), 0);
  };
  for (const Towards towards : {Towards::automatic, Towards::sensors})
    expect_towards(run(scrambled(flat), towards), [&](std::size_t i) { return flat.source[i]; });
  Cloud one = flat;
  one.source.clear();
  one.sensors = {{2.5F, 2.0F, 50.0F}};
  expect_towards(run(scrambled(one), Towards::automatic), [](std::size_t) { return 0; });
}

TEST(NormalOrient, OnlySignsChangeAndThreadsDecideNothing) {
  Cloud flat = scrambled(bench::box_flat(100000));
  flat.sensors.clear();
  flat.source.clear();
  std::string one;
  tbb::task_arena(1).execute([&] { one = content_hash(run(flat, Towards::automatic)); });
  for (const int threads : {2, 4})
    tbb::task_arena(threads).execute([&] { EXPECT_EQ(content_hash(run(flat, Towards::automatic)), one); });
  const Cloud turned = run(flat, Towards::automatic);
  for (std::size_t i = 0; i < flat.size(); ++i)
    ASSERT_TRUE(turned.normals[i] == flat.normals[i] || turned.normals[i] == -flat.normals[i]);
}

TEST(NormalOrient, BadInputs) {
  EXPECT_EQ(run({}, Towards::automatic).size(), 0U);
  Cloud cloud;
  cloud.points = {{1, 2, 3}};
  EXPECT_THROW(run(cloud, Towards::automatic), Error);
  cloud.normals = {{0, 0, 1}};
  EXPECT_EQ(run(cloud, Towards::automatic).normals, cloud.normals);
  EXPECT_THROW(run(cloud, Towards::sensors), Error);
  cloud.sensors = {{0, 0, 0}};
  cloud.source = {3};
  EXPECT_THROW(run(cloud, Towards::automatic), Error);
  cloud.source.clear();
  cloud.sensors.clear();
  cloud.points.assign(5000, {1, 2, 3});
  cloud.normals.assign(5000, {0, 0, 1});
  cloud.points.emplace_back(1e6F, 0, 0);
  cloud.normals.emplace_back(0, 0, 1);
  EXPECT_EQ(run(cloud, Towards::automatic).normals, cloud.normals);
}

}  // namespace
}  // namespace atrium::normal::orient_test
