// What real scans have and ideal ones do not: glass, mirrors, an outside, people, mixed pixels, a walk that drifts.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <functional>
#include <map>
#include <set>

#include "modules/geometry/triangle_tree.hpp"
#include "modules/synth/building.hpp"
#include "modules/synth/flat.hpp"
#include "modules/synth/plan.hpp"
#include "modules/synth/scan.hpp"
#include "modules/synth/two_storeys.hpp"

namespace atrium::synth::scan_effects_test {
namespace {

using V = Eigen::Vector3d;

template <class Scene>
Input<SimulatedScene> built() {
  Context context;
  return input(Scene::run({}, context).scene);
}
/// A cube of 4 m, seen from (1, 2, 1.5); `change` adds to it.
Input<SimulatedScene> cube(const std::function<void(Building&)>& change) {
  Building b;
  b.add_prism("cube", 0, {{0, 0}, {4, 0}, {4, 4}, {0, 4}}, 0, 4);
  change(b);
  auto scene = b.finish();
  scene.positions = {{0, {1, 2, 1.5}}};
  return input(std::move(scene));
}
void add_window(Building& b) {
  const int east = b.wall_of(0, 1);
  b.pierce_outside("window", east, b.on_wall(east, {4, 2}, 2, 0.8, 2.8), 0.3);
}
int add_sheet(Building& b, const std::string& name, double x) {
  const int object = b.add_object(name);
  b.add_polygon(SimulatedScene::object_id(static_cast<std::size_t>(object)),
                {{x, 0.5, 0.5}, {x, 0.5, 3.5}, {x, 3.5, 3.5}, {x, 3.5, 0.5}}, {200, 200, 200});  // seen from the west
  return object;
}
Scan::Params exact(std::int64_t points, Scan::Pattern pattern = Scan::Pattern::spherical) {
  Scan::Params params;
  params.points = points;
  params.pattern = pattern;
  params.noise = params.angular_noise = params.mixed_pixels = params.outliers = 0;
  params.outside = false;
  params.windows = Scan::Windows::open;
  params.sensors = true;
  return params;
}
Scan::Out scan(const Input<SimulatedScene>& scene, const Scan::Params& params, std::uint64_t seed = 1) {
  Context context(seed, std::make_shared<ContextHost>());
  return Scan::run({scene}, params, context);
}
V place(const Cloud& cloud, std::size_t i) { return cloud.points[i].cast<double>(); }
template <class Test>
std::size_t count(const Cloud& cloud, Test test) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) n += test(place(cloud, i), cloud.labels[i]) ? 1 : 0;
  return n;
}

TEST(SynthScanEffects, PositionsAndNormalsAreWrittenOnlyIfAskedFor) {
  Scan::Params params;
  params.points = 1000;
  const auto plain = scan(built<Flat>(), params).cloud;
  EXPECT_TRUE(plain.source.empty());
  EXPECT_TRUE(plain.sensors.empty());
  EXPECT_TRUE(plain.normals.empty());
  params.sensors = true;
  const auto with = scan(built<Flat>(), params).cloud;
  EXPECT_EQ(with.sensors.size(), 8U);
  EXPECT_EQ(with.points, plain.points);
}

TEST(SynthScanEffects, NormalsOfRandomSignKeepTheirAxis) {
  auto params = exact(20000);
  params.normals = true;
  const auto sure = scan(built<Flat>(), params).cloud;
  params.random_signs = true;
  const auto unsure = scan(built<Flat>(), params).cloud;
  std::size_t turned = 0;
  for (std::size_t i = 0; i < unsure.size(); ++i) {
    turned += unsure.labels[i] >= 0 && unsure.normals[i].dot((unsure.sensors[unsure.source[i]] - unsure.points[i])) < 0;
    EXPECT_GT(sure.normals[i].dot(sure.sensors[sure.source[i]] - sure.points[i]), 0);
  }
  const auto on_faces = count(unsure, [](const V&, std::int32_t label) { return label >= 0; });
  EXPECT_NEAR(static_cast<double>(turned) / static_cast<double>(on_faces), 0.5, 0.02);
}

TEST(SynthScanEffects, MostPositionsLimitsTheWholeScan) {
  auto params = exact(1000);
  params.most_positions = 1;
  EXPECT_EQ(scan(built<Flat>(), params).cloud.sensors.size(), 1U);
}

TEST(SynthScanEffects, APaneThrowsItsShareBackAndLetsTheRestPass) {
  int sheet = 0;
  const auto scene = cube([&](Building& b) { sheet = add_sheet(b, "glass", 2); });
  auto params = exact(100000);
  params.glass = 0.2;
  const auto cloud = scan(scene, params).cloud;
  const V eye = scene->positions[0].place;
  std::size_t through = 0, back = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const V p = place(cloud, i), ray = (p - eye) / (p.x() - eye.x());  // meets x = 2 at eye + ray
    if (p.x() < 1.9999 || std::abs(eye.y() + ray.y() - 2) > 1.5 || std::abs(eye.z() + ray.z() - 2) > 1.5) continue;
    (cloud.labels[i] == -2 - sheet ? back : through) += 1;
  }
  ASSERT_GT(back + through, 10000U);
  EXPECT_NEAR(static_cast<double>(back) / static_cast<double>(back + through), 0.2, 0.01);
}

TEST(SynthScanEffects, WindowsAreVoidGlazedOrOpen) {
  const auto scene = cube(add_window);
  const auto outside = -2 - static_cast<std::int32_t>(scene->objects.size()), pane = outside - 1;
  std::map<Scan::Windows, std::pair<std::size_t, std::size_t>> seen;  // of the pane, of the outside
  for (const auto windows : {Scan::Windows::no_return, Scan::Windows::glazed, Scan::Windows::open}) {
    auto params = exact(50000);
    params.outside = true;
    params.windows = windows;
    const auto cloud = scan(scene, params).cloud;
    seen[windows] = {count(cloud, [&](const V&, std::int32_t label) { return label == pane; }),
                     count(cloud, [&](const V&, std::int32_t label) { return label == outside; })};
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      // The pane stands in the middle of the wall of 0.3 m.
      if (cloud.labels[i] == pane) {
        ASSERT_NEAR(cloud.points[i].x(), 4.15, 1e-5);
      }
      // Outside there is ground at 0.4 m below the floor, and all else stands on it.
      if (cloud.labels[i] == outside) {
        ASSERT_GT(cloud.points[i].x(), 4.3);
        ASSERT_GT(cloud.points[i].z(), -0.5);
      }
    }
  }
  EXPECT_EQ(seen[Scan::Windows::no_return], (std::pair<std::size_t, std::size_t>{0, 0}));
  EXPECT_EQ(seen[Scan::Windows::open].first, 0U);
  EXPECT_GT(seen[Scan::Windows::open].second, 500U);
  EXPECT_GT(seen[Scan::Windows::glazed].first, 50U);
  EXPECT_GT(seen[Scan::Windows::glazed].second, 8 * seen[Scan::Windows::glazed].first);
}

TEST(SynthScanEffects, TheOutsideHasGroundAndThingsInTheDistance) {
  const auto scene = cube(add_window);
  auto params = exact(50000);
  params.outside = true;
  // About 160 rays of a scan come down between the sill and the houses, unless a hedge stands before the window (4 of
  // 10).
  std::size_t ground = 0, far = 0, with_ground = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const auto cloud = scan(scene, params, seed).cloud;
    const auto down = count(cloud, [](const V& p, std::int32_t) { return p.x() > 4.4 && p.z() < -0.39; });
    ground += down;
    with_ground += down > 100 ? 1 : 0;
    far += count(cloud, [](const V& p, std::int32_t) { return p.x() > 16 && p.z() > 1; });
  }
  EXPECT_GE(with_ground, 2U);
  EXPECT_LT(ground, 8 * 200U);
  EXPECT_GT(far, 8 * 50U);
  params.outside = false;
  EXPECT_EQ(count(scan(scene, params).cloud, [](const V& p, std::int32_t) { return p.x() > 4.31; }), 0U);
}

TEST(SynthScanEffects, AMirrorShowsTheRoomBehindItself) {
  const auto scene = cube([](Building& b) { add_sheet(b, "mirror", 3.9); });
  const auto cloud = scan(scene, exact(50000)).cloud;
  const TriangleTree tree(scene->vertices, scene->triangles);
  std::size_t mirrored = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    V p = place(cloud, i);
    if (p.x() > 3.91 && cloud.labels[i] == -1) {
      ++mirrored;
      p.x() = 2 * 3.9 - p.x();
    }
    ASSERT_LT(tree.nearest(p).squared_distance, 1e-9) << p.transpose();
  }
  // As many as look at the mirror: 3 m wide and high, 2.9 m away, its lower edge 1 m and its upper 2 m off eye level.
  double share = 0;
  constexpr int steps = 2000;
  for (int i = 0; i < steps; ++i) {
    const double azimuth = (i + 0.5) / steps * std::atan(1.5 / 2.9), range = 2.9 / std::cos(azimuth);
    share += (std::atan(2 / range) + std::atan(1 / range)) / steps;
  }
  share *= std::atan(1.5 / 2.9) / M_PI / (150 * M_PI / 180);
  EXPECT_NEAR(static_cast<double>(mirrored) / 50000, share, 5 * std::sqrt(share / 50000));
  // The mirror itself gives no points.
  EXPECT_EQ(count(cloud, [](const V&, std::int32_t label) { return label == -2; }), 0U);
}

TEST(SynthScanEffects, MixedPixelsLieBetweenBothSidesOfAnEdge) {
  const auto scene = cube([](Building& b) {
    b.add_box(b.add_object("block"), {2.5, 2}, 0, {-0.5, -0.5, 1}, {0.5, 0.5, 2}, {200, 0, 0});
  });
  auto params = exact(200000);
  params.beam = 0.3;
  params.mixed_pixels = 1;
  const auto cloud = scan(scene, params).cloud;
  const TriangleTree tree(scene->vertices, scene->triangles);
  const V eye = scene->positions[0].place;
  std::size_t mixed = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const V ray = (place(cloud, i) - eye).normalized(), u = ray.unitOrthogonal(), v = ray.cross(u);
    const double range = (place(cloud, i) - eye).norm();
    if (cloud.labels[i] != -1) {
      ASSERT_NEAR(tree.cast(eye, ray).distance, range, 1e-4);
      continue;
    }
    ++mixed;
    double near = 1e9, far = 0;
    for (int k = -1; k < 64; ++k) {
      const double r = k < 0 ? 0 : 1.001 * 0.15 * M_PI / 180, a = k * M_PI / 32;
      const double d = tree.cast(eye, (ray + r * (std::cos(a) * u + std::sin(a) * v)).normalized()).distance;
      near = std::min(near, d);
      far = std::max(far, d);
    }
    EXPECT_GT(far - near, 0.03);
    EXPECT_GT(range, near - 0.01);
    EXPECT_LT(range, far + 0.01);
  }
  // The block's front has a rim of about 200 degrees; 2 / pi · 0.15 degrees along it are mixed, of 360 · 150 square
  // degrees.
  EXPECT_NEAR(static_cast<double>(mixed), 71, 35);
}

TEST(SynthScanEffects, AngularNoiseGoesAcrossTheRay) {
  const auto scene = cube([](Building&) {});
  auto params = exact(50000);
  params.angular_noise = 1e-9;
  const auto still = scan(scene, params).cloud;
  params.angular_noise = 0.1;
  const auto moved = scan(scene, params).cloud;
  double across = 0;
  for (std::size_t i = 0; i < still.size(); ++i) {
    const V a = place(still, i) - scene->positions[0].place, b = place(moved, i) - scene->positions[0].place;
    ASSERT_NEAR(a.norm(), b.norm(), 1e-5);
    across += (a - b).squaredNorm() / a.squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(across / 50000 / 2) * 180 / M_PI, 0.1, 0.002);
}

TEST(SynthScanEffects, PeopleAreSeenFromAPartOfThePositions) {
  auto params = exact(50000);
  params.positions = 4;
  params.people = 2;
  const auto scene = built<Flat>();
  const auto person = -2 - static_cast<std::int32_t>(scene->objects.size()) - 2;
  const auto cloud = scan(scene, params).cloud;
  std::map<int, std::size_t> seen;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.labels[i] != person) continue;
    ++seen[cloud.source[i]];
    ASSERT_GT(cloud.points[i].z(), -0.001F);
    ASSERT_LT(cloud.points[i].z(), 1.8F);
  }
  EXPECT_GT(seen.size(), 2U);
  EXPECT_LT(seen.size(), cloud.sensors.size());
  params.people = 0;
  const auto empty = scan(scene, params).cloud;
  EXPECT_EQ(count(empty, [&](const V&, std::int32_t label) { return label == person; }), 0U);
}

/// In which room a place is; −1: in a doorway or outside.
int room_at(const GroundTruth& truth, const V& p) {
  for (std::size_t r = 0; r < truth.rooms.size(); ++r) {
    Ring2 ring;
    for (const auto& c : truth.rooms[r].outline) ring.emplace_back(c.head<2>());
    const double floor = truth.rooms[r].outline[0].z();
    if (inside(ring, p.head<2>()) && p.z() > floor && p.z() < floor + 2) return static_cast<int>(r);
  }
  return -1;
}

TEST(SynthHandHeldScan, WalksThroughAllRoomsAndStaysClearOfWalls) {
  for (const auto& scene : {built<Flat>(), built<TwoStoreys>()}) {
    const auto sensors = scan(scene, exact(20000, Scan::Pattern::hand_held)).cloud.sensors;
    EXPECT_GT(sensors.size(), 200U);
    const TriangleTree tree(scene->vertices, scene->triangles);
    std::set<int> rooms;
    std::size_t jumps = 0, in_doorways = 0, tight = 0;
    for (std::size_t i = 0; i < sensors.size(); ++i) {
      const V p = sensors[i].cast<double>();
      const int room = room_at(scene->truth, p);
      rooms.insert(room);
      in_doorways += room < 0 ? 1 : 0;
      tight += tree.nearest(p).squared_distance < 0.15 * 0.15 ? 1 : 0;
      if (i > 0) jumps += (sensors[i] - sensors[i - 1]).norm() > 0.16F ? 1 : 0;
    }
    for (int room = 0; room < std::ssize(scene->truth.rooms); ++room) EXPECT_EQ(rooms.count(room), 1U) << room;
    EXPECT_GT(in_doorways, 3U);
    EXPECT_LT(in_doorways, sensors.size() / 4);
    EXPECT_EQ(jumps, 0U);
    EXPECT_EQ(tight, 0U);
  }
}

TEST(SynthHandHeldScan, PointsAreSharedEvenlyAlongTheWalk) {
  const auto cloud = scan(built<Flat>(), exact(50000, Scan::Pattern::hand_held)).cloud;
  std::vector<std::size_t> counts(cloud.sensors.size(), 0);
  for (const auto s : cloud.source) ++counts[s];
  const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
  EXPECT_LE(*most - *least, 1U);
}

TEST(SynthHandHeldScan, DriftsSmoothlyAndEverFurther) {
  auto params = exact(20000, Scan::Pattern::hand_held);
  const auto still = scan(built<Flat>(), params).cloud;
  params.drift = 0.06;
  const auto drifted = scan(built<Flat>(), params).cloud;
  const std::size_t n = still.sensors.size();
  ASSERT_EQ(drifted.sensors.size(), n);
  V before = V::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    const V off = (drifted.sensors[i] - still.sensors[i]).cast<double>();
    const double share = static_cast<double>(i) / static_cast<double>(n - 1);
    EXPECT_NEAR(off.norm(), 0.06 * share, 1e-5);
    EXPECT_LT((off - before).norm(), 0.004);
    before = off;
  }
  // Points go with their place.
  for (std::size_t i = 0; i < still.size(); ++i)
    ASSERT_NEAR(
        ((drifted.points[i] - still.points[i]) - (drifted.sensors[drifted.source[i]] - still.sensors[still.source[i]]))
            .norm(),
        0, 1e-5);
}

TEST(SynthHandHeldScan, PointsLieOnSurfaces) {
  const auto scene = built<Flat>();
  const auto cloud = scan(scene, exact(20000, Scan::Pattern::hand_held)).cloud;
  const TriangleTree tree(scene->vertices, scene->triangles);
  for (std::size_t i = 0; i < cloud.size(); ++i) ASSERT_LT(tree.nearest(place(cloud, i)).squared_distance, 1e-10);
}

}  // namespace
}  // namespace atrium::synth::scan_effects_test
