#include "modules/baseline/plane_quadric.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "graph/api/random.hpp"
#include "tests/unit/baseline/meshes.hpp"

namespace atrium::baseline::plane_quadric_test {
namespace {

PlaneQuadric::Out decimated(const Mesh& mesh, const PlaneQuadric::Params& params = {}) {
  Context context;
  return PlaneQuadric::run({input(mesh)}, params, context);
}

Mesh shaken(Mesh mesh, double sigma, std::uint64_t seed) {
  Random random(seed);
  for (auto& v : mesh.vertices) v += sigma * Vector3d(random.normal(), random.normal(), random.normal());
  return mesh;
}

double nearest_vertex(const Mesh& mesh, const Vector3d& place) {
  double least = 1e300;
  for (const auto& v : mesh.vertices) least = std::min(least, (v - place).norm());
  return least;
}

void expect_closed_manifold(const Mesh& mesh) {
  EXPECT_EQ(validity(mesh, "closed"), 1);
  EXPECT_EQ(validity(mesh, "edges.non_manifold"), 0);
  EXPECT_EQ(validity(mesh, "vertices.non_manifold"), 0);
  EXPECT_EQ(validity(mesh, "edges.misoriented"), 0);
  EXPECT_EQ(validity(mesh, "degenerate_faces"), 0);
  EXPECT_EQ(validity(mesh, "duplicate_faces"), 0);
}

TEST(PlaneQuadric, ABoxIsLeftWithTwelveTrianglesAndItsExactCorners) {
  const auto out = decimated(box(Vector3d(4, 5, 2.5), 10));
  EXPECT_EQ(out.planes, 6);
  EXPECT_EQ(out.mesh.triangles.size(), 12U);
  ASSERT_EQ(out.mesh.vertices.size(), 8U);
  for (const double x : {0.0, 4.0})
    for (const double y : {0.0, 5.0})
      for (const double z : {0.0, 2.5}) EXPECT_LT(nearest_vertex(out.mesh, Vector3d(x, y, z)), 1e-12);
  EXPECT_NEAR(volume(out.mesh), 50, 1e-10);
  expect_closed_manifold(out.mesh);
  EXPECT_EQ(validity(out.mesh, "self_intersections.crossing"), 0);
}

TEST(PlaneQuadric, PrimitivesAreTheSidesByFallingArea) {
  const auto out = decimated(box(Vector3d(4, 5, 2.5), 10));
  ASSERT_EQ(out.mesh.primitives.size(), out.mesh.triangles.size());
  const double areas[] = {20, 20, 12.5, 12.5, 10, 10};
  for (int p = 0; p < 6; ++p) {
    Mesh side = out.mesh;
    side.triangles.clear();
    for (std::size_t t = 0; t < out.mesh.triangles.size(); ++t)
      if (out.mesh.primitives[t] == p) side.triangles.push_back(out.mesh.triangles[t]);
    EXPECT_NEAR(area(side), areas[p], 1e-9);
  }
}

TEST(PlaneQuadric, AnOpenSheetKeepsItsOutline) {
  Mesh sheet;
  add_grid(sheet, Vector3d(1, 2, 3), Vector3d(4, 0, 1), Vector3d(0, 3, 0), 20);
  const Mesh mesh = decimated(sheet, {.max_error = 0.001}).mesh;
  EXPECT_EQ(mesh.triangles.size(), 2U);
  EXPECT_NEAR(area(mesh), area(sheet), 1e-6);
  EXPECT_EQ(mesh.primitives, (std::vector<std::int32_t>{0, 0}));
}

TEST(PlaneQuadric, TwoPlanesKeepTheLineWhereTheyMeet) {
  Mesh bent;
  add_grid(bent, Vector3d::Zero(), Vector3d(3, 0, 0), Vector3d(0, 4, 0), 20);
  add_grid(bent, Vector3d::Zero(), Vector3d(0, 4, 0), Vector3d(0, 0, 2.5), 20);
  bent = welded(bent);
  const auto out = decimated(bent, {.max_error = 0.001});
  EXPECT_EQ(out.planes, 2);
  EXPECT_EQ(out.mesh.triangles.size(), 4U);
  EXPECT_NEAR(area(out.mesh), 12 + 10, 1e-6);
  EXPECT_LT(nearest_vertex(out.mesh, Vector3d::Zero()), 1e-6);
  EXPECT_LT(nearest_vertex(out.mesh, Vector3d(0, 4, 0)), 1e-6);
}

TEST(PlaneQuadric, NoiseGoesIntoThePlanes) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Mesh noisy = shaken(box(Vector3d(4, 5, 2.5), 60), 0.004, seed);
    const auto out = decimated(noisy);
    EXPECT_EQ(out.planes, 6);
    EXPECT_LE(out.mesh.triangles.size(), 60U);
    expect_closed_manifold(out.mesh);
    EXPECT_NEAR(volume(out.mesh), 50, 0.05);
    for (const double x : {0.0, 4.0}) EXPECT_LT(nearest_vertex(out.mesh, Vector3d(x, 5, 2.5)), 0.01);
  }
}

TEST(PlaneQuadric, WhatIsNotFlatKeepsItsShapeAndReachesTheTarget) {
  const Mesh ball = sphere(Vector3d(1, 2, 3), 0.3, 30);
  const auto out = decimated(ball, {.triangles = 500, .max_error = 0, .distance = 0.002});
  EXPECT_EQ(out.planes, 0);
  EXPECT_LE(out.mesh.triangles.size(), 500U);
  EXPECT_GE(out.mesh.triangles.size(), 498U);
  expect_closed_manifold(out.mesh);
  EXPECT_LT(greatest_distance(out.mesh, ball), 0.3 * 5 / 500);
  EXPECT_EQ(out.mesh.primitives, std::vector<std::int32_t>(out.mesh.triangles.size(), -1));
}

TEST(PlaneQuadric, ATorusKeepsItsHole) {
  Mesh ring;  // a square frame: box minus a box through it
  const Mesh outer = box(Vector3d(3, 3, 1), 12);
  std::vector<std::array<std::uint32_t, 3>> kept;
  const auto in_hole = [](const Vector3d& c) { return c.x() > 1 && c.x() < 2 && c.y() > 1 && c.y() < 2; };
  ring = outer;
  for (const auto& t : outer.triangles)
    if (!in_hole((outer.vertices[t[0]] + outer.vertices[t[1]] + outer.vertices[t[2]]) / 3)) kept.push_back(t);
  ring.triangles = kept;
  const Vector3d z(0, 0, 1);
  add_grid(ring, Vector3d(1, 1, 0), z, Vector3d(1, 0, 0), 4);
  add_grid(ring, Vector3d(2, 1, 0), z, Vector3d(0, 1, 0), 4);
  add_grid(ring, Vector3d(2, 2, 0), z, Vector3d(-1, 0, 0), 4);
  add_grid(ring, Vector3d(1, 2, 0), z, Vector3d(0, -1, 0), 4);
  ring = welded(ring);
  ASSERT_EQ(validity(ring, "closed"), 1);
  const auto out = decimated(ring);
  EXPECT_EQ(out.planes, 10);
  EXPECT_EQ(out.mesh.triangles.size(), 32U);  // as few as 16 corners and one hole allow
  EXPECT_EQ(out.mesh.vertices.size(), 16U);
  EXPECT_NEAR(area(out.mesh), 2 * 8 + 12 + 4, 1e-9);
  expect_closed_manifold(out.mesh);
}

/// What run() warned of and told.
struct Told : ContextHost {
  std::string text;
  void log(Level /*level*/, std::string_view line) override { text += std::string(line) + "\n"; }
};

TEST(PlaneQuadric, ForATargetPatchesThatCostLeastAreGivenUpFirst) {
  // A box with a low bump of 12 cm on one side: with borders kept, its corners stay; twelve triangles are the box's.
  Mesh bump = box(Vector3d(4, 5, 2.5), 50);
  std::size_t raised = 0;
  for (auto& v : bump.vertices)
    if (std::abs(v.z() - 2.5) < 1e-9 && v.x() > 1.9 && v.x() < 2.1 && v.y() > 2.45 && v.y() < 2.55) {
      v.z() += 0.12;
      ++raised;
    }
  ASSERT_GT(raised, 1U);
  const PlaneQuadric::Params kept{.max_error = 0.001};
  EXPECT_GT(decimated(bump, kept).mesh.triangles.size(), 12U);
  const auto host = std::make_shared<Told>();
  Context context(1, host);
  const Mesh mesh = PlaneQuadric::run({input(bump)}, {.triangles = 12, .max_error = 0}, context).mesh;
  EXPECT_EQ(mesh.triangles.size(), 12U);
  EXPECT_NE(host->text.find("given up"), std::string::npos) << host->text;
  expect_closed_manifold(mesh);
  for (const double x : {0.0, 4.0})
    for (const double y : {0.0, 5.0})
      for (const double z : {0.0, 2.5}) EXPECT_LT(nearest_vertex(mesh, Vector3d(x, y, z)), 0.06);
  EXPECT_NEAR(volume(mesh), 50, 0.3);  // the bump's planes pull at the corner that it went into
}

TEST(PlaneQuadric, ForATargetClutterGoesAndTheWallsStay) {
  // A third of one side of a box is rough by 15 cm, as furniture is: it is in no plane.
  for (const std::uint64_t seed : {1, 2, 3}) {
    Mesh rough = box(Vector3d(4, 5, 2.5), 40);
    Random random(seed);
    for (auto& v : rough.vertices)
      if (v.z() > 2.4 && (v - Vector3d(2, 2.5, 2.5)).norm() < 1.5) v.z() += random.uniform(-0.15, 0.15);
    for (const std::int64_t target : {400, 100, 30}) {
      const Mesh mesh = decimated(rough, {.triangles = target, .max_error = 0}).mesh;
      EXPECT_LE(mesh.triangles.size(), static_cast<std::size_t>(target));
      EXPECT_GE(mesh.triangles.size(), static_cast<std::size_t>(target) - 1);
      expect_closed_manifold(mesh);
      for (const double x : {0.0, 4.0})
        for (const double y : {0.0, 5.0})
          for (const double z : {0.0, 2.5}) EXPECT_LT(nearest_vertex(mesh, Vector3d(x, y, z)), 0.01) << target;
      EXPECT_NEAR(volume(mesh), 50, 0.5) << target;
    }
  }
}

TEST(PlaneQuadric, BordersStayWhereTheTargetDoesNotNeedThem) {
  // A staircase of ten steps, open at its sides: twenty rectangles.
  Mesh stairs;
  const std::int64_t steps = 10;
  const Vector3d across(0, 1, 0);
  for (int i = 0; i < 10; ++i) {
    const Vector3d foot(0.3 * i, 0, 0.2 * i), top = foot + Vector3d(0, 0, 0.2);
    add_grid(stairs, foot, Vector3d(0, 0, 0.2), across, 4);
    add_grid(stairs, top, Vector3d(0.3, 0, 0), across, 4);
  }
  const std::size_t all = stairs.triangles.size();
  const Mesh open = welded(stairs);
  const auto out = decimated(open, {.triangles = 2 * 2 * steps, .max_error = 0});
  EXPECT_EQ(out.planes, 2 * steps);
  EXPECT_EQ(out.mesh.triangles.size(), 40U);
  EXPECT_NEAR(area(out.mesh), 10 * (0.2 + 0.3), 1e-9);
  EXPECT_LT(out.mesh.triangles.size(), all);
  // Half as many: some steps are gone, and the rest still climbs from end to end.
  const Mesh fewer = decimated(open, {.triangles = 2 * steps, .max_error = 0}).mesh;
  EXPECT_LE(fewer.triangles.size(), 20U);
  EXPECT_GE(fewer.triangles.size(), 2U);
  EXPECT_EQ(validity(fewer, "edges.non_manifold"), 0);
  EXPECT_EQ(validity(fewer, "components.all"), 1);
  EXPECT_LT(greatest_distance(fewer, open), 0.2);
}

TEST(PlaneQuadric, TheLargestErrorHoldsBordersTooAndIsNamed) {
  // A corner of a box moved anywhere is further off than two centimetres.
  const auto host = std::make_shared<Told>();
  Context context(1, host);
  const Mesh cube = box(Vector3d(4, 5, 2.5), 10);
  EXPECT_EQ(PlaneQuadric::run({input(cube)}, {.triangles = 8}, context).mesh.triangles.size(), 12U);
  EXPECT_NE(host->text.find("12 triangles are left, 8 were wanted"), std::string::npos) << host->text;
  EXPECT_NE(host->text.find("max_error"), std::string::npos);
  const Mesh eight = decimated(cube, {.triangles = 8, .max_error = 0}).mesh;
  EXPECT_EQ(eight.triangles.size(), 8U);
  expect_closed_manifold(eight);
  // A tetrahedron is the least that is closed.
  const Mesh four = decimated(cube, {.triangles = 1, .max_error = 0}).mesh;
  EXPECT_EQ(four.triangles.size(), 4U);
  expect_closed_manifold(four);
}

TEST(PlaneQuadric, SmallRegionsAreFree) {
  Mesh step;
  add_grid(step, Vector3d::Zero(), Vector3d(1, 0, 0), Vector3d(0, 1, 0), 10);
  EXPECT_EQ(decimated(step, {.min_area = 0.99}).planes, 1);
  EXPECT_EQ(decimated(step, {.min_area = 1.01}).planes, 0);
}

TEST(PlaneQuadric, KeepsColumnsAndOrigin) {
  Mesh cube = box(Vector3d(1, 1, 1), 8);
  cube.origin = {5e5, 5.4e6, 100};
  cube.colours.assign(cube.vertices.size(), Colour{1, 2, 3});
  cube.classes.assign(cube.triangles.size(), SurfaceClass::wall);
  cube.storeys.assign(cube.triangles.size(), 4);
  const Mesh mesh = decimated(cube).mesh;
  EXPECT_EQ(mesh.origin, cube.origin);
  EXPECT_EQ(mesh.colours.size(), mesh.vertices.size());
  EXPECT_EQ(mesh.classes, std::vector<SurfaceClass>(mesh.triangles.size(), SurfaceClass::wall));
  EXPECT_EQ(mesh.storeys, std::vector<std::int32_t>(mesh.triangles.size(), 4));
}

TEST(PlaneQuadric, TakesWhatIsNoManifold) {
  Mesh fan;
  for (const auto& out : {Vector3d(1, 0, 0), Vector3d(-1, 0.2, 0), Vector3d(0.1, 1, 0)})
    add_grid(fan, Vector3d::Zero(), out, Vector3d(0, 0, 1), 6);
  fan = welded(fan);
  fan.triangles.push_back(fan.triangles.front());
  fan.triangles.push_back({0, 1, 1});
  Mesh bow = box(Vector3d(1, 1, 1), 4);  // two cubes that touch in a corner
  const auto other = static_cast<std::uint32_t>(bow.vertices.size());
  Mesh second = bow;
  for (auto& v : second.vertices) bow.vertices.emplace_back(v + Vector3d(1, 1, 1));
  for (auto t : second.triangles) {
    for (auto& v : t) v += other;
    bow.triangles.push_back(t);
  }
  bow = welded(bow);
  EXPECT_LT(decimated(fan, {.min_area = 0.01}).mesh.triangles.size(), 60U);
  const Mesh cubes = decimated(bow).mesh;
  EXPECT_EQ(cubes.triangles.size(), 24U);
  EXPECT_NEAR(volume(cubes), 2, 1e-9);
}

TEST(PlaneQuadric, SameBytesWithAnyNumberOfThreads) {
  const Mesh noisy = shaken(box(Vector3d(4, 5, 2.5), 70), 0.003, 7);
  EXPECT_TRUE(same_with_any_threads([&] { return content_hash(decimated(noisy).mesh); }));
}

TEST(PlaneQuadric, BadInputIsAnErrorAndNothingGivesNothing) {
  const Mesh cube = box(Vector3d(1, 1, 1), 2);
  EXPECT_NE(error_of([&] { decimated(cube, {.max_error = 0}); }).find("neither"), std::string::npos);
  Mesh broken = cube;
  broken.vertices[4].x() = std::numeric_limits<double>::infinity();
  EXPECT_NE(error_of([&] { decimated(broken); }).find("vertex 4"), std::string::npos);
  EXPECT_TRUE(decimated({}).mesh.triangles.empty());
  Mesh spot;
  spot.vertices.assign(3, Vector3d(1, 1, 1));
  spot.triangles = {{0, 1, 2}, {0, 2, 1}};
  EXPECT_EQ(decimated(spot).planes, 0);
}

}  // namespace
}  // namespace atrium::baseline::plane_quadric_test
