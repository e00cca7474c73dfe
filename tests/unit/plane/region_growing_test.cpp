#include "modules/plane/region_growing.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "tests/support/flat_cloud.hpp"

namespace atrium::plane::region_growing_test {
namespace {

using test::box_faces;
using test::furnished_flat;
using test::match_faces;
using test::sample;

PlanePrimitives grow(Cloud cloud, const RegionGrowing::Params& params = {}) {
  Context context;
  return RegionGrowing::run({input(std::move(cloud))}, params, context).planes;
}

TEST(PlaneRegionGrowing, FindsTheSixPlanesOfABoxAndTurnsThemInwards) {
  const auto faces = box_faces({-2, -1.5, 0}, {2, 1.5, 2.5}, true);
  const PlanePrimitives planes = grow(sample(faces, {.points = 200000, .normals = false}));
  ASSERT_EQ(planes.primitives.size(), 6U);
  for (const auto& match : match_faces(faces, planes)) {
    EXPECT_GT(match.best_iou, 0.95);
    EXPECT_LT(match.angle, 0.05);
    EXPECT_LT(match.offset, 0.0005);
  }
}

TEST(PlaneRegionGrowing, FindsEveryStructuralPlaneOfAFurnishedFlat) {
  const auto faces = furnished_flat();
  const PlanePrimitives planes = grow(sample(faces, {.points = 600000, .normals = false}));
  for (const auto& match : match_faces(faces, planes)) {
    if (!faces[match.face].structural || faces[match.face].area() < 0.5) continue;
    EXPECT_GT(match.best_iou, 0.9) << "face " << match.face;
    EXPECT_LT(match.angle, 0.1) << "face " << match.face;  // the sides of the thin walls look into their rooms
    EXPECT_LT(match.offset, 0.001) << "face " << match.face;
  }
}

TEST(PlaneRegionGrowing, TurnsPlanesToTheSensorOrTheNormals) {
  const auto faces = box_faces({0, 0, 0}, {2, 2, 2}, false);  // seen from without
  Cloud cloud = sample({faces[1]}, {.points = 20000, .outliers = 0, .normals = false});
  cloud.sensors = {{1, 1, 5}};
  EXPECT_GT(grow(cloud).primitives.at(0).plane.normal.z(), 0.99);
  cloud.sensors = {{1, 1, -5}};
  EXPECT_LT(grow(cloud).primitives.at(0).plane.normal.z(), -0.99);
  cloud.normals.assign(cloud.size(), {0, 0, 1});
  EXPECT_LT(grow(cloud).primitives.at(0).plane.normal.z(), -0.99);  // the position tells more
  cloud.sensors.clear();
  EXPECT_GT(grow(cloud).primitives.at(0).plane.normal.z(), 0.99);  // nothing else does
}

// The longest way through the scene is what tells a room from a wall's inside and from the outside, however wide it is;
// normals of random sign, and ones that all look the wrong way, do not matter.
TEST(PlaneRegionGrowing, TurnsPlanesIntoTheirRoomsWhateverTheNormals) {
  auto faces = box_faces({0, 0, 0}, {12, 11, 3}, true);
  const auto more = box_faces({12.12, 0, 0}, {16, 11, 3}, true);
  faces.insert(faces.end(), more.begin(), more.end());
  Cloud cloud = sample(faces, {.points = 200000});
  for (const int pattern : {0, 1, 2}) {
    for (std::size_t i = 0; i < cloud.normals.size(); ++i)
      if (pattern == 1 || (pattern == 2 && i % 2 == 0)) cloud.normals[i] = -cloud.normals[i];
    for (const auto& match : match_faces(faces, grow(cloud))) EXPECT_LT(match.angle, 1) << pattern;
  }
}

// A cavity between two small rooms, wider than what is free before their walls: nothing stands at its rim.
TEST(PlaneRegionGrowing, TurnsPlanesAwayFromACavityThatIsWiderThanTheRoomsAreFree) {
  auto faces = box_faces({0, 0, 0}, {1.5, 2.8, 2.5}, true);
  const auto add = [&](const std::vector<test::Face>& more) { faces.insert(faces.end(), more.begin(), more.end()); };
  add(box_faces({2.25, 0, 0}, {3.75, 2.8, 2.5}, true));
  const std::size_t walls = faces.size();
  add(box_faces({0.7, 0.1, 0}, {1.18, 2.7, 2.4}, false));
  add(box_faces({2.57, 0.1, 0}, {3.05, 2.7, 2.4}, false));
  const PlanePrimitives planes = grow(sample(faces, {.points = 200000, .normals = false}));
  for (const auto& match : match_faces(faces, planes)) {
    if (match.face >= walls || std::abs(faces[match.face].normal().x()) < 0.9) continue;
    EXPECT_LT(match.angle, 1) << "face " << match.face;
  }
}

// A model's solids have outer faces, too, before which there is nothing, and behind which the inner ones stand.
TEST(PlaneRegionGrowing, TurnsTheOuterFacesOfABuildingOutwards) {
  auto faces = box_faces({0, 0, 0}, {5, 4, 2.5}, true);
  const auto outer = box_faces({-0.3, -0.3, -0.25}, {5.3, 4.3, 2.75}, false);
  faces.insert(faces.end(), outer.begin(), outer.end());
  const auto matches = match_faces(faces, grow(sample(faces, {.points = 200000, .normals = false})));
  EXPECT_EQ(matches.size(), faces.size());
  for (const auto& match : matches) EXPECT_LT(match.angle, 1) << "face " << match.face;
}

TEST(PlaneRegionGrowing, DerivesItsDistanceFromTheNoise) {
  const auto faces = box_faces({-2, -1.5, 0}, {2, 1.5, 2.5}, true);
  for (const double noise : {0.001, 0.008}) {
    const PlanePrimitives planes =
        grow(sample(faces, {.points = 200000, .noise = noise, .normals = false}), {.distance = 0});
    EXPECT_EQ(planes.primitives.size(), 6U) << noise;
    for (const auto& match : match_faces(faces, planes)) EXPECT_GT(match.best_iou, 0.9) << noise;
  }
}

TEST(PlaneRegionGrowing, KeepsTheLargest) {
  const auto faces = box_faces({0, 0, 0}, {5, 4, 2.5}, true);
  const PlanePrimitives planes = grow(sample(faces, {.points = 100000}), {.max_planes = 2});
  ASSERT_EQ(planes.primitives.size(), 2U);
  for (const auto& p : planes.primitives) EXPECT_GT(std::abs(p.plane.normal.z()), 0.99);
}

TEST(PlaneRegionGrowing, FindsBothFacesOfAWallThinnerThanAVoxel) {
  // The spacing asks for voxels of 16 cm; wherever they lie, some of these walls of 12 cm stand within one layer.
  for (int step = 0; step < 8; ++step) {
    const double x = 3 + 0.045 * step;
    auto faces = box_faces({0, 0, 0}, {x, 3, 2.5}, true);
    const auto more = box_faces({x + 0.12, 0, 0}, {9, 3, 2.5}, true);
    faces.insert(faces.end(), more.begin(), more.end());
    const PlanePrimitives planes =
        grow(sample(faces, {.points = 40000, .normals = false}), {.min_voxel_size = 0.08, .passes = 3});
    for (const auto& match : match_faces(faces, planes)) {
      if (std::abs(faces[match.face].normal().x()) < 0.9) continue;
      EXPECT_GT(match.best_iou, 0.8) << "face " << match.face << " at " << x;
    }
  }
}

TEST(PlaneRegionGrowing, SameBytesWithAnyNumberOfThreads) {
  const Cloud cloud = sample(furnished_flat(), {.points = 60000, .normals = false});
  const std::string expected = content_hash(grow(cloud));
  for (const std::size_t threads : {1, 2, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(content_hash(grow(cloud)), expected) << threads;
  }
}

TEST(PlaneRegionGrowing, FindsNothingWhereThereIsNothing) {
  EXPECT_TRUE(
      grow(sample(box_faces({0, 0, 0}, {5, 4, 2.5}, true), {.points = 20000, .outliers = 1})).primitives.empty());
  Cloud line;
  for (int i = 0; i < 1000; ++i) line.points.emplace_back(static_cast<float>(i) * 0.001F, 0.0F, 0.0F);
  EXPECT_TRUE(grow(line).primitives.empty());
  Cloud one;
  one.points.assign(5000, {1, 2, 3});
  EXPECT_TRUE(grow(one).primitives.empty());
}

TEST(PlaneRegionGrowing, AFarOutlierChangesNothing) {
  Cloud cloud = sample(box_faces({0, 0, 0}, {3, 3, 3}, true), {.points = 60000, .outliers = 0});
  cloud.points.emplace_back(1e9F, -1e9F, 0.0F);
  cloud.points.emplace_back(-1e30F, 0.0F, 0.0F);
  cloud.normals.clear();
  EXPECT_EQ(grow(cloud).primitives.size(), 6U);
}

// Both faces of a wall of 12 cm are in one neighbourhood where points are 10 cm apart; in most voxels only one is.
TEST(PlaneRegionGrowing, ThinWallsInASparseCloudAreNoNoise) {
  auto faces = box_faces({0, 0, 0}, {4, 4, 2.5}, true);
  const auto more = box_faces({4.12, 0, 0}, {8, 4, 2.5}, true);
  faces.insert(faces.end(), more.begin(), more.end());
  const auto matches = match_faces(faces, grow(sample(faces, {.points = 14000, .noise = 0.002, .normals = false})));
  EXPECT_EQ(matches.size(), faces.size());
  for (const auto& match : matches) EXPECT_LT(std::abs(match.offset), 0.01) << "face " << match.face;
}

TEST(PlaneRegionGrowing, AHandfulOfPointsIsNoPlane) {
  Cloud cloud;
  for (const auto& p :
       {Eigen::Vector3f(.01F, .01F, .05F), Eigen::Vector3f(.29F, .01F, .05F), Eigen::Vector3f(.01F, .29F, .05F),
        Eigen::Vector3f(.29F, .29F, .05F), Eigen::Vector3f(.15F, .15F, .05F)})
    cloud.points.push_back(p);
  EXPECT_TRUE(grow(cloud).primitives.empty());
}

TEST(PlaneRegionGrowing, SaysWhatIsMissing) {
  Cloud cloud;
  EXPECT_THROW(grow(cloud), Error);
  cloud.points = {{0, 0, 0}, {1, 0, 0}};
  EXPECT_THROW(grow(cloud), Error);
}

}  // namespace
}  // namespace atrium::plane::region_growing_test
