#include "modules/baseline/extruded_plan.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <optional>

#include "graph/api/random.hpp"
#include "modules/baseline/plan_image.hpp"
#include "modules/baseline/ring_outline.hpp"
#include "modules/geometry/ear_clipping.hpp"
#include "tests/unit/baseline/meshes.hpp"

namespace atrium::baseline::extruded_plan_test {
namespace {

using Eigen::Vector2d;

ExtrudedPlan::Out extruded(const std::optional<FloorPlan>& plan, const std::optional<Cloud>& cloud,
                           const ExtrudedPlan::Params& params = {}) {
  Context context;
  ExtrudedPlan::In in;
  if (plan) in.plan = input(*plan);
  if (cloud) in.cloud = input(*cloud);
  return ExtrudedPlan::run(in, params, context);
}

FloorPlan plan_of(const PlanPolygon& polygon, double height) {
  FloorPlan plan;
  plan.storeys.resize(1);
  plan.storeys[0].elevation = 1;
  plan.storeys[0].rooms.push_back({"room", polygon, height});
  return plan;
}
PlanRing rectangle(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }
PlanRing reversed(PlanRing ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

double area_of(const Mesh& mesh, SurfaceClass surface) {
  Mesh part = mesh;
  part.triangles.clear();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mesh.classes[t] == surface) part.triangles.push_back(mesh.triangles[t]);
  return area(part);
}

/// Points on the floor, ceiling and walls of a room, seen from inside, with noise and normals.
void scan_room(Cloud& cloud, const PlanRing& ring, double floor, double ceiling, double noise, Random& random) {
  const auto add = [&](const Vector3d& p, const Vector3d& n) {
    cloud.points.emplace_back((p + noise * random.normal() * n).cast<float>());
    cloud.normals.emplace_back(n.cast<float>());
  };
  const PlanPolygon polygon{ring, {}};
  for (const auto& t : clip_ears(polygon)) {
    const Vector2d a = ring[t[0]], b = ring[t[1]] - a, c = ring[t[2]] - a;
    const auto count = static_cast<int>(1500 * 0.5 * std::abs(b.x() * c.y() - b.y() * c.x()));
    for (int i = 0; i < 2 * count; ++i) {
      double u = random.uniform(), v = random.uniform();
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Vector2d p = a + u * b + v * c;
      const bool top = i % 2 == 0;
      add(Vector3d(p.x(), p.y(), top ? ceiling : floor), Vector3d(0, 0, top ? -1 : 1));
    }
  }
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2d a = ring[i], d = ring[(i + 1) % ring.size()] - a;
    const Vector2d inward = Vector2d(-d.y(), d.x()).normalized();
    for (int k = 0; k < static_cast<int>(1500 * d.norm() * (ceiling - floor)); ++k) {
      const Vector2d p = a + random.uniform() * d;
      add(Vector3d(p.x(), p.y(), random.uniform(floor, ceiling)), Vector3d(inward.x(), inward.y(), 0));
    }
  }
}
PlanRing turned(PlanRing ring, double angle) {
  for (auto& p : ring) p = Eigen::Rotation2Dd(angle) * p;
  return ring;
}
double nearest_corner(const PlanRing& ring, const Vector2d& place) {
  double least = 1e300;
  for (const auto& p : ring) least = std::min(least, (p - place).norm());
  return least;
}

TEST(PlanImage, BordersRunAroundSquaresAndHoles) {
  PlanImage image(Vector2d(1, 2), 0.5, 6, 5);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 6; ++x) image.at(x, y) = x == 2 && y == 2 ? 0 : 1;
  const PlanPolygon border = border_of(image, 1);
  EXPECT_DOUBLE_EQ(border.area(), 29 * 0.25);
  ASSERT_EQ(border.holes.size(), 1U);
  EXPECT_EQ(border.holes[0].size(), 4U);
  std::vector<std::size_t> sizes;
  image.at(0, 1) = image.at(1, 0) = 0;  // cuts a corner off
  components(image, sizes);
  EXPECT_EQ(sizes, (std::vector<std::size_t>{1, 26}));
  EXPECT_EQ(eroded(dilated(image, 1), 1).at(2, 2), 1);
}

TEST(RingOutline, SimplifiesToTheCorners) {
  PlanRing ring;
  for (const auto& [a, b] : {std::pair{Vector2d(0, 0), Vector2d(4, 0)},
                             {Vector2d(4, 0), Vector2d(4, 3)},
                             {Vector2d(4, 3), Vector2d(0, 3)},
                             {Vector2d(0, 3), Vector2d(0, 0)}})
    for (int i = 0; i < 40; ++i) ring.emplace_back(a + (b - a) * i / 40.0);
  EXPECT_EQ(simplified(ring, 0.1), (std::vector<std::size_t>{0, 40, 80, 120}));
  std::rotate(ring.begin(), ring.begin() + 17, ring.end());
  EXPECT_EQ(simplified(ring, 0.1), (std::vector<std::size_t>{23, 63, 103, 143}));
  EXPECT_NEAR(main_direction({turned(ring, 0.3)}), 0.3, 1e-9);
}

TEST(ExtrudedPlan, ARoomBecomesAClosedPrism) {
  const PlanPolygon ell{{{0, 0}, {6, 0}, {6, 2}, {3, 2}, {3, 5}, {0, 5}}, {}};
  const Mesh mesh = extruded(plan_of(ell, 2.4), {}).mesh;
  EXPECT_EQ(mesh.triangles.size(), 4U * 6 - 4);
  EXPECT_EQ(validity(mesh, "watertight"), 1);
  EXPECT_NEAR(volume(mesh), -21 * 2.4, 1e-9);  // seen from inside
  EXPECT_NEAR(area_of(mesh, SurfaceClass::floor), 21, 1e-9);
  EXPECT_NEAR(area_of(mesh, SurfaceClass::ceiling), 21, 1e-9);
  EXPECT_NEAR(area_of(mesh, SurfaceClass::wall), 22 * 2.4, 1e-9);
  EXPECT_EQ(mesh.primitives.back(), 7);
  for (const auto& v : mesh.vertices) EXPECT_TRUE(v.z() == 1 || v.z() == 3.4);
}

TEST(ExtrudedPlan, HolesAndWindingsDoNotMatter) {
  const PlanPolygon ring{reversed(rectangle(0, 0, 6, 5)), {rectangle(2, 2, 3, 3)}};
  const Mesh mesh = extruded(plan_of(ring, 2), {}).mesh;
  EXPECT_EQ(validity(mesh, "watertight"), 1);
  EXPECT_NEAR(volume(mesh), -29 * 2, 1e-9);
}

TEST(ExtrudedPlan, HeightsComeFromThePlanElseTheCloudElseTheParameter) {
  const PlanPolygon room{rectangle(0, 0, 4, 3), {}};
  Cloud cloud;
  Random random(1);
  scan_room(cloud, room.outline, -0.3, 2.4, 0.002, random);
  EXPECT_NEAR(volume(extruded(plan_of(room, 2), cloud).mesh), -24, 1e-9);
  const auto out = extruded(plan_of(room, 0), cloud);
  EXPECT_NEAR(out.plan.storeys[0].elevation, -0.3, 0.002);
  EXPECT_NEAR(out.plan.storeys[0].height, 2.7, 0.003);
  EXPECT_NEAR(volume(extruded(plan_of(room, 0), {}, {.height = 3}).mesh), -36, 1e-9);
  FloorPlan floors;
  floors.storeys.resize(1);
  floors.storeys[0].floors.push_back(room);
  EXPECT_NEAR(volume(extruded(floors, {}).mesh), -30, 1e-9);
}

TEST(ExtrudedPlan, DrawsTwoRoomsFromACloud) {
  const double angle = 0.4;
  const std::vector<PlanRing> rooms{turned({{0, 0}, {5, 0}, {5, 4}, {2, 4}, {2, 3}, {0, 3}}, angle),
                                    turned(rectangle(5.2, 0, 8, 4), angle)};
  Cloud cloud;
  cloud.origin = {5e5, 5.4e6, 0};
  Random random(3);
  for (const auto& ring : rooms) scan_room(cloud, ring, 0.1, 2.6, 0.005, random);
  const auto out = extruded({}, cloud);
  ASSERT_EQ(out.plan.storeys[0].rooms.size(), 2U);
  EXPECT_EQ(out.mesh.origin, cloud.origin);
  for (const auto& ring : rooms) {
    const auto& found = out.plan.storeys[0].rooms;
    for (const auto& corner : ring)
      EXPECT_LT(
          std::min(nearest_corner(found[0].polygon.outline, corner), nearest_corner(found[1].polygon.outline, corner)),
          0.03);
  }
  EXPECT_EQ(out.mesh.triangles.size(), (4U * 6 - 4) + (4U * 4 - 4));
  EXPECT_EQ(validity(out.mesh, "watertight"), 1);
  EXPECT_NEAR(volume(out.mesh), -(18 + 11.2) * 2.5, 0.5);
}

/// Points on the sides of something that stands in the room, from below up to `top`.
void scan_sides(Cloud& cloud, const PlanRing& ring, double from, double top, Random& random) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2d a = ring[i], d = ring[(i + 1) % ring.size()] - a;
    const Vector2d outward = Vector2d(d.y(), -d.x()).normalized();
    for (int k = 0; k < static_cast<int>(2500 * d.norm() * (top - from)); ++k) {
      const Vector2d p = a + random.uniform() * d;
      cloud.points.emplace_back(Vector3d(p.x(), p.y(), random.uniform(from, top)).cast<float>());
      cloud.normals.emplace_back(static_cast<float>(outward.x()), static_cast<float>(outward.y()), 0.0F);
    }
  }
}

TEST(ExtrudedPlan, FurnitureMakesNoCorners) {
  const PlanRing ell{{0, 0}, {6, 0}, {6, 3}, {3, 3}, {3, 5}, {0, 5}};
  Cloud cloud;
  Random random(11);
  scan_room(cloud, ell, 0, 2.6, 0.004, random);
  scan_sides(cloud, rectangle(1, 4.4, 2.5, 5), 0, 2.1, random);         // a wardrobe at a wall
  scan_sides(cloud, rectangle(5.35, 1.2, 5.75, 1.6), 0, 2.55, random);  // a column just before one
  scan_sides(cloud, rectangle(4.5, 2.6, 4.54, 3), 0, 2.55, random);     // the side of a shelf that reaches the ceiling
  const auto out = extruded({}, cloud);
  ASSERT_EQ(out.plan.storeys.size(), 1U);
  ASSERT_EQ(out.plan.storeys[0].rooms.size(), 1U);
  const auto& found = out.plan.storeys[0].rooms[0].polygon;
  EXPECT_EQ(found.outline.size(), 6U);
  EXPECT_TRUE(found.holes.empty());
  for (const auto& corner : ell) EXPECT_LT(nearest_corner(found.outline, corner), 0.03);
}

TEST(ExtrudedPlan, DrawsEachStoreyByItself) {
  const std::vector<PlanRing> rooms{rectangle(0, 0, 5, 4), rectangle(0, 0, 3, 4)};
  for (const bool with_normals : {true, false}) {
    Cloud cloud;
    cloud.origin = {10, 20, 30};
    Random random(2);
    scan_room(cloud, rooms[0], 0, 2.5, 0.004, random);
    scan_room(cloud, rooms[1], 2.8, 5.4, 0.004, random);
    scan_sides(cloud, rectangle(2, 2, 2.5, 2.5), 0, 0.75, random);
    if (!with_normals) cloud.normals.clear();
    const auto out = extruded({}, cloud);
    ASSERT_EQ(out.plan.storeys.size(), 2U) << with_normals;
    EXPECT_NEAR(out.plan.storeys[0].elevation, 0, 0.01);
    EXPECT_NEAR(out.plan.storeys[1].elevation, 2.8, 0.01);
    EXPECT_NEAR(out.plan.storeys[1].height, 2.6, 0.02);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(out.plan.storeys[k].index, static_cast<int>(k));
      ASSERT_EQ(out.plan.storeys[k].rooms.size(), 1U);
      EXPECT_NEAR(out.plan.storeys[k].rooms[0].polygon.area(), PlanPolygon({rooms[k], {}}).area(), 0.6);
    }
    if (!with_normals) continue;
    // A plan of both storeys takes its heights from them; one of three is told that they do not fit.
    FloorPlan plan;
    plan.origin = cloud.origin;
    for (int k = 0; k < 2; ++k) {
      plan.storeys.emplace_back();
      plan.storeys.back().index = k;
      plan.storeys.back().rooms.push_back({"", {rooms[static_cast<std::size_t>(k)], {}}, 0});
    }
    const auto given = extruded(plan, cloud);
    EXPECT_NEAR(given.plan.storeys[1].elevation, 2.8, 0.01);
    EXPECT_NEAR(given.plan.storeys[0].height, 2.5, 0.02);
    plan.storeys.push_back(plan.storeys[1]);
    EXPECT_NEAR(extruded(plan, cloud).plan.storeys[0].height, 5.4, 0.02);
  }
}

TEST(ExtrudedPlan, AMezzanineAndALowSlabAreNoStorey) {
  // A large table, a bed and a hanging ceiling: level, but too low to stand under, or too small.
  Cloud cloud;
  Random random(4);
  scan_room(cloud, rectangle(0, 0, 5, 4), 0, 2.6, 0.003, random);
  for (int i = 0; i < 4000; ++i) {
    cloud.points.emplace_back(static_cast<float>(random.uniform(1, 3)), static_cast<float>(random.uniform(1, 3)),
                              0.75F);
    cloud.normals.emplace_back(0.0F, 0.0F, 1.0F);
    cloud.points.emplace_back(static_cast<float>(random.uniform(1, 3)), static_cast<float>(random.uniform(1, 3)), 2.2F);
    cloud.normals.emplace_back(0.0F, 0.0F, -1.0F);
  }
  EXPECT_EQ(extruded({}, cloud).plan.storeys.size(), 1U);
}

TEST(ExtrudedPlan, NeedsNoNormals) {
  Cloud cloud;
  Random random(3);
  scan_room(cloud, rectangle(0, 0, 5, 4), 0, 2.5, 0.004, random);
  cloud.normals.clear();
  const auto out = extruded({}, cloud);
  ASSERT_EQ(out.plan.storeys[0].rooms.size(), 1U);
  EXPECT_EQ(out.plan.storeys[0].rooms[0].polygon.outline.size(), 4U);
  EXPECT_NEAR(out.plan.storeys[0].rooms[0].polygon.area(), 20, 0.6);
}

TEST(ExtrudedPlan, SameBytesWithAnyNumberOfThreads) {
  Cloud cloud;
  Random random(9);
  for (int i = 0; i < 4; ++i) scan_room(cloud, rectangle(3 * i, 0, 3 * i + 2.8, 3), 0, 2.5, 0.005, random);
  EXPECT_TRUE(same_with_any_threads([&] { return content_hash(extruded({}, cloud).mesh); }));
}

TEST(ExtrudedPlan, BadInputIsAnError) {
  EXPECT_NE(error_of([] { extruded({}, {}); }).find("neither"), std::string::npos);
  EXPECT_NE(error_of([] { extruded(FloorPlan{}, {}); }).find("neither rooms"), std::string::npos);
  EXPECT_NE(error_of([] { extruded(plan_of({{{0, 0}, {1, 1}}, {}}, 2), {}); }).find("2 corners"), std::string::npos);
  PlanRing wild = rectangle(0, 0, 1, 1);
  wild[2].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(error_of([&] { extruded(plan_of({wild, {}}, 2), {}); }).find("not finite"), std::string::npos);
  EXPECT_NE(error_of([] { extruded({}, Cloud{}); }).find("0 points"), std::string::npos);
  Cloud flat;
  for (int i = 0; i < 1000; ++i)
    flat.points.emplace_back(0.01F * static_cast<float>(i % 30), 0.01F * static_cast<float>(i / 30), 0.0F);
  EXPECT_NE(error_of([&] { extruded({}, flat); }).find("0.00 m apart"), std::string::npos);
}

}  // namespace
}  // namespace atrium::baseline::extruded_plan_test
