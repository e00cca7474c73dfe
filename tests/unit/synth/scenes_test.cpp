#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "modules/geometry/triangle_tree.hpp"
#include "modules/synth/attic.hpp"
#include "modules/synth/office.hpp"
#include "modules/synth/polygon_room.hpp"
#include "modules/synth/room.hpp"
#include "modules/synth/round_room.hpp"
#include "modules/synth/scan.hpp"
#include "modules/synth/two_storeys.hpp"
#include "scene_checks.hpp"

namespace atrium::synth::scenes_test {
namespace {

template <class Scene>
SimulatedScene build(const typename Scene::Params& params = {}, std::uint64_t seed = 1) {
  Context context(seed, std::make_shared<ContextHost>());
  return Scene::run(params, context).scene;
}

/// Every position sees surfaces from their front all around, but through windows: it stands in the building, in no
/// object.
void check_positions(const SimulatedScene& scene) {
  const TriangleTree tree(scene.vertices, scene.triangles);
  Random random(4);
  for (const auto& position : scene.positions) {
    int misses = 0, backs = 0;
    for (int i = 0; i < 500; ++i) {
      const Eigen::Vector3d direction(random.normal(), random.normal(), random.normal());
      const auto hit = tree.cast(position.place, direction);
      misses += hit ? 0 : 1;
      backs += hit && !hit.front ? 1 : 0;
    }
    EXPECT_EQ(backs, 0) << position.place.transpose();
    EXPECT_LT(misses, 150) << position.place.transpose();
  }
}

template <class Scene>
class SynthScene : public testing::Test {};
using Scenes = testing::Types<Room, TwoStoreys, Attic, Office, PolygonRoom, RoundRoom>;
TYPED_TEST_SUITE(SynthScene, Scenes);

TYPED_TEST(SynthScene, IsExactAndClosedWithAnyFurniture) {
  for (const double furniture : {0.0, 1.0, 3.0})
    for (const std::uint64_t seed : {1, 2, 3}) {
      typename TypeParam::Params params;
      params.furniture = furniture;
      const auto scene = build<TypeParam>(params, seed);
      check_scene(scene);
      check_positions(scene);
    }
}

TYPED_TEST(SynthScene, FollowsItsSeed) {
  EXPECT_EQ(content_hash(build<TypeParam>({}, 1)), content_hash(build<TypeParam>({}, 1)));
  EXPECT_NE(content_hash(build<TypeParam>({}, 1)), content_hash(build<TypeParam>({}, 2)));
}

TYPED_TEST(SynthScene, ScannerSeesEveryFaceOfTheEmptyBuilding) {
  typename TypeParam::Params params;
  params.furniture = 0;
  const auto scene = build<TypeParam>(params);
  Context context;
  Scan::Params scan;
  scan.points = 200000;
  scan.outliers = 0;
  scan.pattern = Scan::Pattern::uniform_area;
  const auto out = Scan::run({input(scene)}, scan, context);
  std::set<std::int32_t> seen(out.cloud.labels.begin(), out.cloud.labels.end());
  for (std::int32_t face = 0; face < std::ssize(scene.truth.faces); ++face) EXPECT_EQ(seen.count(face), 1U) << face;
}

TYPED_TEST(SynthScene, PointsWithoutNoiseLieOnTheirFacesOrOnObjects) {
  const auto scene = build<TypeParam>();
  const TriangleTree tree(scene.vertices, scene.triangles);
  Context context;
  Scan::Params params;
  params.points = 20000;
  params.noise = params.outliers = params.angular_noise = params.mixed_pixels = 0;
  params.outside = false;
  params.windows = Scan::Windows::open;
  const auto out = Scan::run({input(scene)}, params, context);
  std::size_t structure = 0, objects = 0;
  for (std::size_t i = 0; i < out.cloud.size(); ++i) {
    const Eigen::Vector3d p = out.cloud.points[i].template cast<double>();
    const auto label = out.cloud.labels[i];
    const auto nearest = tree.nearest_of(p, 1e-8, [&](std::uint32_t t) { return scene.surfaces[t] == label; });
    ASSERT_TRUE(nearest) << p.transpose() << " of " << label;
    ++(label >= 0 ? structure : objects);
  }
  EXPECT_GT(structure, 10000U);
  EXPECT_GT(objects, 500U);
}

TEST(SynthRoom, IsAnL) {
  const auto truth = build<Room>().truth;
  EXPECT_EQ(truth.faces.size(), 8U);
  const double area = 6 * 5 - 2.4 * 2;
  EXPECT_NEAR(truth.faces[0].area(), area, 1e-12);
  EXPECT_NEAR(room_volume(truth, 0), area * 2.6, 1e-9);
  Room::Params rectangle;
  rectangle.notch_depth = 0;
  EXPECT_EQ(build<Room>(rectangle).truth.faces.size(), 6U);
  Room::Params gone;
  gone.notch_width = 5.5;
  EXPECT_THROW(build<Room>(gone), Error);
}

TEST(SynthTwoStoreys, HasStairsThroughAnOpening) {
  const auto scene = build<TwoStoreys>();
  const auto& truth = scene.truth;
  EXPECT_EQ(truth.rooms.size(), 6U);
  std::set<int> storeys;
  for (const auto& face : truth.faces) storeys.insert(face.storey);
  EXPECT_EQ(storeys, (std::set<int>{0, 1}));
  const auto slab =
      std::find_if(truth.openings.begin(), truth.openings.end(), [](const auto& o) { return o.kind == "slab"; });
  ASSERT_NE(slab, truth.openings.end());
  EXPECT_NEAR(slab->thickness, 0.25, 1e-12);
  const double hole = area_vector(slab->outline).norm();
  EXPECT_GT(hole, 2);
  EXPECT_NEAR(truth.faces[slab->face_a].area(), 0.34 * 9.5 * 7.5 - hole, 1e-9);
  EXPECT_NEAR(truth.faces[slab->face_b].area(), 0.34 * 9.5 * 7.5 - hole, 1e-9);
  EXPECT_EQ(truth.rooms[slab->room_a].name, "hall");
  EXPECT_EQ(truth.rooms[slab->room_b].name, "landing");
  for (int room = 0; room < 3; ++room) EXPECT_GT(room_volume(truth, room), 10);
  // Treads: upward surfaces of the stairs, evenly spaced between the floors.
  std::set<int> heights;
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    const auto object = -2 - scene.surfaces[t];
    if (object < 0 || scene.objects[object] != "stairs") continue;
    const auto& [a, b, c] = scene.triangles[t];
    const auto& v = scene.vertices;
    const Eigen::Vector3d n = (v[b] - v[a]).cross(v[c] - v[a]).normalized();
    if (n.z() > 0.99) heights.insert(static_cast<int>(std::round(v[a].z() * 1e6)));
  }
  EXPECT_EQ(heights.size(), 15U);
  int last = 0;
  for (const int z : heights) {
    EXPECT_NEAR(z - last, 2.8e6 / 16, 2);
    last = z;
  }
  TwoStoreys::Params steep;
  steep.depth = 7;
  steep.ceiling_height = 3;
  steep.slab = 0.6;
  EXPECT_THROW(build<TwoStoreys>(steep), Error);
}

TEST(SynthAttic, HasTheVolumeOfItsSection) {
  Attic::Params params;
  const double slope = std::tan(40 * M_PI / 180);
  for (const double collar : {2.6, 20.0})
    for (const bool dormer : {false, true}) {
      params.collar_height = collar;
      params.dormer = dormer;
      const auto truth = build<Attic>(params).truth;
      const double top = std::min(collar, 1.1 + slope * 3.5), in = (top - 1.1) / slope;
      const double section = 7 * 1.1 + (top - 1.1) * (7 - in);
      // The dormer is a wedge: 1.6 m times half its front times its length.
      const double wedge = dormer ? 1.6 * (2.2 - 1.1) * (2.2 - 1.1) / slope / 2 : 0;
      EXPECT_NEAR(room_volume(truth, 0), section * 0.55 * 9 + wedge, 1e-9);
      EXPECT_NEAR(room_volume(truth, 1), section * (0.45 * 9 - 0.12), 1e-9);
      int slanted = 0;
      for (const auto& face : truth.faces)
        slanted +=
            face.surface == SurfaceClass::ceiling && std::abs(face.plane.normal.z() + std::cos(40 * M_PI / 180)) < 1e-9;
      EXPECT_EQ(slanted, 4);
      EXPECT_EQ(truth.openings.size(), dormer ? 6U : 5U);
    }
  params.slope = 25;
  params.depth = 5;
  params.knee_height = 0.3;
  EXPECT_THROW(build<Attic>(params), Error);
}

}  // namespace
}  // namespace atrium::synth::scenes_test
