#include "modules/synth/scan.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Geometry>
#include <numeric>
#include <set>

#include "modules/geometry/triangle_tree.hpp"
#include "modules/synth/building.hpp"
#include "modules/synth/flat.hpp"

namespace atrium::synth::scan_test {
namespace {

Input<SimulatedScene> flat() {
  static const auto scene = [] {
    Context context;
    return input(Flat::run({}, context).scene);
  }();
  return scene;
}
/// A cube of 4 m with a box of 1 m in its middle that hides what is behind.
Input<SimulatedScene> cube() {
  Building b;
  b.add_prism("cube", 0, {{0, 0}, {4, 0}, {4, 4}, {0, 4}}, 0, 4);
  b.add_box(b.add_object("block"), {2, 2}, 0, {-0.5, -0.5, 1}, {0.5, 0.5, 2}, {200, 0, 0});
  auto scene = b.finish();
  scene.positions = {{0, {0.5, 2, 1.5}}};
  return input(std::move(scene));
}
Scan::Params exact(std::int64_t points, Scan::Pattern pattern = Scan::Pattern::spherical) {
  Scan::Params params;
  params.points = points;
  params.pattern = pattern;
  params.noise = params.angular_noise = params.mixed_pixels = 0;
  params.outliers = 0;
  params.outside = false;
  params.windows = Scan::Windows::open;
  params.sensors = true;
  return params;
}
Scan::Out scan(const Input<SimulatedScene>& scene, const Scan::Params& params, std::uint64_t seed = 1) {
  Context context(seed, std::make_shared<ContextHost>());
  return Scan::run({scene}, params, context);
}
Eigen::Vector3d place(const Cloud& cloud, std::size_t i) { return cloud.points[i].cast<double>(); }

TEST(SynthScan, EveryNoiseFreePointLiesOnItsSurface) {
  const auto scene = flat();
  for (const auto pattern : {Scan::Pattern::spherical, Scan::Pattern::uniform_area}) {
    const auto out = scan(scene, exact(20000, pattern));
    // One tree per surface id: the distance to that surface alone.
    std::map<std::int32_t, TriangleTree> trees;
    for (std::size_t i = 0; i < out.cloud.size(); ++i) {
      const auto label = out.cloud.labels[i];
      if (trees.count(label) == 0) {
        std::vector<std::array<std::uint32_t, 3>> own;
        for (std::size_t t = 0; t < scene->triangles.size(); ++t)
          if (scene->surfaces[t] == label) own.push_back(scene->triangles[t]);
        trees.emplace(label, TriangleTree(scene->vertices, own));
      }
      ASSERT_LT(trees[label].nearest(place(out.cloud, i)).squared_distance, 2e-6 * 2e-6) << label;
    }
    EXPECT_GT(trees.size(), 40U);
  }
}

TEST(SynthScan, CountIsExactAndColumnsAreWhole) {
  for (const std::int64_t points : {1, 7, 16383, 16385, 50000}) {
    const auto cloud = scan(flat(), exact(points)).cloud;
    EXPECT_EQ(cloud.points.size(), static_cast<std::size_t>(points));
    EXPECT_EQ(cloud.colours.size(), cloud.size());
    EXPECT_EQ(cloud.labels.size(), cloud.size());
    EXPECT_EQ(cloud.source.size(), cloud.size());
    EXPECT_TRUE(cloud.normals.empty());
    EXPECT_EQ(cloud.sensors.size(), 8U);
  }
}

TEST(SynthScan, WhatIsHiddenGivesNoPoints) {
  const auto scene = cube();
  const TriangleTree tree(scene->vertices, scene->triangles);
  for (const auto pattern : {Scan::Pattern::spherical, Scan::Pattern::uniform_area}) {
    auto params = exact(40000, pattern);
    params.lowest_elevation = -90;
    const auto cloud = scan(scene, params).cloud;
    std::set<std::int32_t> seen(cloud.labels.begin(), cloud.labels.end());
    EXPECT_EQ(seen.size(), 7U);  // six faces and the block
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Eigen::Vector3d p = place(cloud, i), from = scene->positions[0].place;
      EXPECT_FALSE(tree.blocked(from, p - from, 1 - 1e-5));
      // The block's shadow on the wall x = 4, by proportion from its front edges: y and z between 0.5 … 3.5 about
      // (2, 1.5).
      if (cloud.labels[i] == 3) {
        EXPECT_FALSE(std::abs(p.y() - 2) < 1.7 && std::abs(p.z() - 1.5) < 1.45) << p.transpose();
      }
    }
  }
}

TEST(SynthScan, NoiseHasItsSizeAndDirection) {
  auto params = exact(100000);
  params.noise = 0.01;
  params.normals = true;
  const auto scene = cube();
  const auto out = scan(scene, params);
  double sum = 0, squares = 0;
  std::size_t n = 0;
  for (std::size_t i = 0; i < out.cloud.size(); ++i) {
    if (out.cloud.labels[i] < 0) continue;
    const auto& plane = out.truth.faces[out.cloud.labels[i]].plane;
    const Eigen::Vector3d p = place(out.cloud, i), ray = (p - scene->positions[0].place).normalized();
    const double along_ray = plane.signed_distance(p) / plane.normal.dot(ray);
    sum += along_ray;
    squares += along_ray * along_ray;
    ++n;
    EXPECT_LT(out.cloud.normals[i].cast<double>().dot(ray), 0);
    EXPECT_NEAR(out.cloud.normals[i].norm(), 1, 1e-6);
  }
  EXPECT_NEAR(sum / static_cast<double>(n), 0, 2e-4);
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(n)), 0.01, 2e-4);
}

TEST(SynthScan, OutliersHaveTheirShare) {
  auto params = exact(100000);
  params.outliers = 0.05;
  const auto cloud = scan(flat(), params).cloud;
  const auto outliers = std::count(cloud.labels.begin(), cloud.labels.end(), -1);
  EXPECT_NEAR(static_cast<double>(outliers), 5000, 350);
}

TEST(SynthScan, UniformPatternHasEqualDensityOnWhatIsSeen) {
  Building b;
  b.add_prism("empty", 0, {{0, 0}, {6, 0}, {6, 4}, {0, 4}}, 0, 2.5);
  const auto out = scan(input(b.finish()), exact(100000, Scan::Pattern::uniform_area));
  std::vector<double> counts(6, 0);
  for (const auto label : out.cloud.labels) ++counts[static_cast<std::size_t>(label)];
  double total = 0;
  for (const auto& face : out.truth.faces) total += face.area();
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(counts[i] / 1e5, out.truth.faces[i].area() / total, 0.004) << i;
}

TEST(SynthScan, PoseAndUtmOffsetAreExact) {
  auto params = exact(5000);
  params.yaw = 23;
  params.tilt = 2.5;
  params.offset = {500000.123, 5400000.456, 312.789};
  const auto out = scan(flat(), params);
  EXPECT_EQ(out.cloud.origin, Eigen::Vector3d(500000.123, 5400000.456, 312.789));
  EXPECT_EQ(out.truth.origin, out.cloud.origin);
  EXPECT_EQ(out.mesh.origin, out.cloud.origin);
  for (std::size_t i = 0; i < out.cloud.size(); ++i)
    if (out.cloud.labels[i] >= 0) {
      ASSERT_NEAR(out.truth.faces[out.cloud.labels[i]].plane.signed_distance(place(out.cloud, i)), 0, 2e-6);
    }
  // Back in the scene's frame it is the unposed scan.
  const auto plain = scan(flat(), exact(5000));
  const Eigen::Matrix3d back = (Eigen::AngleAxisd(2.5 * M_PI / 180, Eigen::Vector3d::UnitX()) *
                                Eigen::AngleAxisd(23 * M_PI / 180, Eigen::Vector3d::UnitZ()))
                                   .toRotationMatrix()
                                   .transpose();
  for (std::size_t i = 0; i < out.cloud.size(); ++i)
    ASSERT_LT((back * place(out.cloud, i) - place(plain.cloud, i)).norm(), 3e-6);
  // Floors look along the tilted vertical.
  EXPECT_NEAR(out.truth.faces[0].plane.normal.z(), std::cos(2.5 * M_PI / 180), 1e-12);
}

TEST(SynthScan, CeilingsCanStayUnseenAndTrue) {
  for (const auto pattern : {Scan::Pattern::spherical, Scan::Pattern::uniform_area}) {
    auto params = exact(30000, pattern);
    const auto with = scan(flat(), params);
    params.ceilings = false;
    const auto without = scan(flat(), params);
    EXPECT_EQ(without.cloud.size(), 30000U);
    EXPECT_EQ(content_hash(with.truth), content_hash(without.truth));
    const auto on_ceilings = [](const Scan::Out& out) {
      return std::count_if(out.cloud.labels.begin(), out.cloud.labels.end(), [&](std::int32_t label) {
        return label >= 0 && out.truth.faces[label].surface == SurfaceClass::ceiling;
      });
    };
    EXPECT_GT(on_ceilings(with), 3000);
    EXPECT_EQ(on_ceilings(without), 0);
    // Walls are seen up to where the ceiling begins: the kitchen's, 2.7 m.
    float top = 0;
    for (const auto& p : without.cloud.points) top = std::max(top, p.z());
    EXPECT_GT(top, 2.6F);
    EXPECT_LT(top, 2.7001F);
  }
}

TEST(SynthScan, ShuffledPointsAreTheSamePoints) {
  Scan::Params params;
  params.points = 20000;
  params.normals = true;
  params.sensors = true;
  const auto ordered = scan(flat(), params).cloud;
  params.shuffle = true;
  const auto shuffled = scan(flat(), params).cloud;
  using Point = std::tuple<float, float, float, int, int, int, float>;
  const auto rows = [](const Cloud& cloud) {
    std::vector<Point> points;
    for (std::size_t i = 0; i < cloud.size(); ++i)
      points.emplace_back(cloud.points[i].x(), cloud.points[i].y(), cloud.points[i].z(), cloud.labels[i],
                          cloud.source[i], cloud.colours[i][0], cloud.normals[i].x());
    return points;
  };
  auto a = rows(ordered), b = rows(shuffled);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < a.size(); ++i) kept += a[i] == b[i] ? 1 : 0;
  EXPECT_LT(kept, 50U);
  // No trace of the order: of the first half of the scan about half lies in the first half.
  const std::set<Point> first(a.begin(), a.begin() + 10000);
  const auto stayed = std::count_if(b.begin(), b.begin() + 10000, [&](const Point& p) { return first.count(p) != 0; });
  EXPECT_NEAR(static_cast<double>(stayed), 5000, 400);
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  EXPECT_EQ(a, b);
}

TEST(SynthScan, PositionsDriftBySqrt6TimesTheParameterFromEachOther) {
  auto params = exact(1000);
  const auto still = scan(flat(), params).cloud.sensors;
  params.drift = 0.0122;
  double squares = 0;
  int pairs = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const auto moved = scan(flat(), params, seed).cloud.sensors;
    for (std::size_t i = 1; i < moved.size(); ++i)
      for (std::size_t k = i + 1; k < moved.size(); ++k, ++pairs)
        squares += ((moved[i] - still[i]) - (moved[k] - still[k])).squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(squares / pairs), 0.03, 0.002);
}

TEST(SynthScan, DriftMovesEachPositionButTheFirstRigidly) {
  auto params = exact(40000);
  const auto still = scan(flat(), params).cloud;
  params.drift = 0.03;
  params.drift_angle = 0.3;
  const auto drifted = scan(flat(), params).cloud;
  std::vector<double> moved(still.sensors.size(), 0);
  for (std::size_t i = 0; i < still.size(); ++i) {
    ASSERT_EQ(still.source[i], drifted.source[i]);
    moved[still.source[i]] = std::max(moved[still.source[i]], (place(still, i) - place(drifted, i)).norm());
    // Rigid: ranges from the scanner stay.
    const auto s = still.source[i];
    ASSERT_NEAR((still.points[i] - still.sensors[s]).norm(), (drifted.points[i] - drifted.sensors[s]).norm(), 1e-5);
  }
  EXPECT_EQ(moved[0], 0);
  for (std::size_t s = 1; s < moved.size(); ++s) {
    EXPECT_GT(moved[s], 0.002);
    EXPECT_LT(moved[s], 0.5);
  }
}

TEST(SynthScan, SameBytesWithAnyNumberOfThreads) {
  Scan::Params params;
  params.points = 100000;
  params.drift = 0.02;
  params.people = 2;
  std::set<std::string> hashes;
  for (const std::size_t threads : {1, 2, 4}) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    for (const auto pattern : {Scan::Pattern::spherical, Scan::Pattern::uniform_area, Scan::Pattern::hand_held}) {
      params.pattern = pattern;
      hashes.insert(content_hash(scan(flat(), params).cloud));
    }
  }
  EXPECT_EQ(hashes.size(), 3U);
  EXPECT_EQ(hashes.count(content_hash(scan(flat(), params, 2).cloud)), 0U);
}

TEST(SynthScan, BlindOrHomelessScannerIsAnError) {
  auto params = exact(10);
  params.max_range = 0.2;
  EXPECT_THROW(scan(flat(), params), Error);
  EXPECT_THROW(scan(input(SimulatedScene{}), exact(10)), Error);
  params = exact(10);
  params.offset = {1, 2};
  EXPECT_THROW(scan(flat(), params), Error);
}

}  // namespace
}  // namespace atrium::synth::scan_test
