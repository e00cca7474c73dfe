#include "modules/metric/primitives.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "meshes.hpp"
#include "modules/metric/region_overlap.hpp"
#include "modules/synth/flat.hpp"
#include "modules/synth/scan.hpp"

namespace atrium::metric::primitives_test {
namespace {

using V = Eigen::Vector3d;

/// Two floors, 2 × 2 m side by side at z = 0 with 400 labelled points each, and a wall at x = 4 with 400.
struct Scene {
  GroundTruth truth;
  std::shared_ptr<Cloud> cloud = std::make_shared<Cloud>();
  Scene() {
    const auto face = [&](SurfaceClass surface, const V& corner, const V& a, const V& b) {
      const auto index = static_cast<int>(truth.faces.size());
      TrueFace f;
      f.surface = surface;
      f.outline = {corner, corner + a, corner + a + b, corner + b};
      f.plane.normal = a.cross(b).normalized();
      f.plane.offset = -f.plane.normal.dot(corner);
      truth.faces.push_back(f);
      add_rectangle(truth.mesh, corner, a, b, surface, index);
      for (int i = 0; i < 400; ++i) {
        const V p = corner + a * ((i % 20 + 0.5) / 20) + b * ((i / 20 + 0.5) / 20);
        cloud->points.emplace_back(p.cast<float>());
        cloud->labels.push_back(index);
      }
    };
    face(SurfaceClass::floor, V(0, 0, 0), V(2, 0, 0), V(0, 2, 0));
    face(SurfaceClass::floor, V(2, 0, 0), V(2, 0, 0), V(0, 2, 0));
    face(SurfaceClass::wall, V(4, 0, 0), V(0, 0, 2), V(0, 2, 0));
  }
  PlanePrimitive primitive(int face, std::uint32_t first, std::uint32_t last) const {
    PlanePrimitive p;
    p.plane = truth.faces[static_cast<std::size_t>(face)].plane;
    for (auto i = first; i < last; ++i) p.inliers.push_back(i);
    return p;
  }
  Metrics compare(const std::vector<PlanePrimitive>& found, const Primitives::Params& params = {}) const {
    Context context;
    return Primitives::run({input(PlanePrimitives{cloud, found}), input(truth)}, params, context).metrics;
  }
};
double of(const Metrics& m, const std::string& name) { return value(m, "primitives." + name); }

TEST(MetricPrimitives, IdenticalIsPerfect) {
  const Scene s;
  const auto m = s.compare({s.primitive(0, 0, 400), s.primitive(1, 400, 800), s.primitive(2, 800, 1200)});
  for (const char* t : {"t50.", "t80."}) {
    EXPECT_EQ(of(m, std::string(t) + "recall"), 1);
    EXPECT_EQ(of(m, std::string(t) + "precision"), 1);
    for (const char* key : {"oversegmented", "undersegmented", "missed", "noise"})
      EXPECT_EQ(of(m, std::string(t) + key), 0);
  }
  EXPECT_EQ(of(m, "purity"), 1);
  EXPECT_EQ(of(m, "coverage"), 1);
  EXPECT_NEAR(of(m, "offset_error.max"), 0, 1e-9);
  EXPECT_EQ(of(m, "normal_error.max"), 0);
}

TEST(MetricPrimitives, AMergeASplitAMissAndNoise) {
  const Scene s;
  // Both floors as one.
  auto m = s.compare({s.primitive(0, 0, 800), s.primitive(2, 800, 1200)});
  EXPECT_EQ(of(m, "t80.undersegmented"), 1);
  EXPECT_EQ(of(m, "t80.correct"), 1);
  EXPECT_EQ(of(m, "t80.missed"), 0);
  EXPECT_EQ(of(m, "t80.noise"), 0);
  EXPECT_NEAR(of(m, "purity"), 800.0 / 1200, 1e-12);
  EXPECT_NEAR(of(m, "coverage"), 800.0 / 1200, 1e-12);
  // The wall in three pieces, the second floor not found.
  m = s.compare(
      {s.primitive(0, 0, 400), s.primitive(2, 800, 950), s.primitive(2, 950, 1080), s.primitive(2, 1080, 1200)});
  EXPECT_EQ(of(m, "t80.oversegmented"), 1);
  EXPECT_EQ(of(m, "t80.correct"), 1);
  EXPECT_EQ(of(m, "t80.missed"), 1);
  EXPECT_EQ(of(m, "t80.noise"), 0);
  EXPECT_NEAR(of(m, "t80.recall"), 1.0 / 3, 1e-12);
  EXPECT_EQ(of(m, "t80.precision"), 0.25);
  EXPECT_EQ(of(m, "purity"), 1);
  // 70 % of a face: correct at one half, missed and noise at 80 %.
  m = s.compare({s.primitive(0, 0, 280)});
  EXPECT_EQ(of(m, "t50.correct"), 1);
  EXPECT_EQ(of(m, "t50.missed"), 2);
  EXPECT_EQ(of(m, "t80.correct"), 0);
  EXPECT_EQ(of(m, "t80.missed"), 3);
  EXPECT_EQ(of(m, "t80.noise"), 1);
}

TEST(MetricPrimitives, ObjectsCountApart) {
  Scene s;
  for (int i = 0; i < 100; ++i) {
    s.cloud->points.emplace_back(1 + 0.01F * static_cast<float>(i), 1, 0.7F);
    s.cloud->labels.push_back(-3);
  }
  const auto m = s.compare({s.primitive(0, 0, 400), s.primitive(0, 1200, 1300)});
  EXPECT_EQ(of(m, "found"), 2);
  EXPECT_EQ(of(m, "on_objects"), 1);
  EXPECT_EQ(of(m, "t80.noise"), 0);
  EXPECT_EQ(of(m, "t80.precision"), 1);
  // Without labels the nearest face decides, and the table is on none.
  s.cloud->labels.clear();
  const auto n = s.compare({s.primitive(0, 0, 400), s.primitive(0, 1200, 1300)});
  EXPECT_EQ(n.values.size(), m.values.size());
  for (std::size_t i = 0; i < m.values.size(); ++i)
    EXPECT_NEAR(n.values[i].value, m.values[i].value, 0.03) << m.values[i].name;
}

TEST(MetricPrimitives, PlanesThatStandOffAndLean) {
  const Scene s;
  auto moved = s.primitive(0, 0, 400), leaning = s.primitive(2, 800, 1200);
  moved.plane.offset = -0.03;  // 3 cm above the floor
  // Turned by 2° about the wall's middle.
  const V middle(4, 1, 1);
  leaning.plane.normal = Eigen::AngleAxisd(2 * M_PI / 180, V::UnitY()) * leaning.plane.normal;
  leaning.plane.offset = -leaning.plane.normal.dot(middle);
  const auto m = s.compare({moved, leaning});
  EXPECT_NEAR(of(m, "offset_error.max"), 0.03, 1e-6);
  EXPECT_NEAR(of(m, "offset_error.median"), 0, 1e-6);
  EXPECT_NEAR(of(m, "normal_error.max"), 2, 1e-6);
  EXPECT_NEAR(of(m, "normal_error.median"), 0, 1e-6);
  // The direction of the normal does not matter.
  auto turned = s.primitive(0, 0, 400);
  turned.plane = {-turned.plane.normal, -turned.plane.offset};
  EXPECT_EQ(of(s.compare({turned}), "normal_error.max"), 0);
}

TEST(MetricPrimitives, TruthOfAScanAgreesWithItself) {
  Context context;
  auto scene = input(synth::Flat::run({}, context).scene);
  synth::Scan::Params params;
  params.points = 50000;
  params.yaw = 23;
  params.offset = {500000, 5400000, 300};
  auto scan = synth::Scan::run({scene}, params, context);
  PlanePrimitives planes{std::make_shared<Cloud>(scan.cloud), {}};
  for (std::size_t f = 0; f < scan.truth.faces.size(); ++f) {
    PlanePrimitive p;
    p.plane = scan.truth.faces[f].plane;  // both have the same origin
    for (std::uint32_t i = 0; i < scan.cloud.size(); ++i)
      if (scan.cloud.labels[i] == static_cast<std::int32_t>(f)) p.inliers.push_back(i);
    if (p.inliers.size() >= 50) planes.primitives.push_back(p);
  }
  const auto m = Primitives::run({input(planes), input(scan.truth)}, {}, context).metrics;
  EXPECT_EQ(of(m, "t80.recall"), 1);
  EXPECT_EQ(of(m, "t80.precision"), 1);
  EXPECT_EQ(of(m, "purity"), 1);
  EXPECT_EQ(of(m, "coverage"), 1);
  EXPECT_LT(of(m, "offset_error.max"), 1e-6);
}

TEST(MetricPrimitives, EmptyAndBadInput) {
  const Scene s;
  const auto m = s.compare({});
  EXPECT_EQ(of(m, "t80.recall"), 0);
  EXPECT_EQ(of(m, "t80.missed"), 3);
  EXPECT_FALSE(has(m, "primitives.t80.precision"));
  EXPECT_FALSE(has(m, "primitives.purity"));
  EXPECT_FALSE(has(m, "primitives.normal_error.max"));
  Context context;
  EXPECT_THROW(Primitives::run({input(PlanePrimitives{s.cloud, {}}), input(GroundTruth{})}, {}, context), Error);
  Scene other;
  other.cloud->labels[7] = 3;
  EXPECT_THROW(other.compare({}), Error);
  Primitives::Params params;
  params.thresholds = {0.555};
  EXPECT_THROW(s.compare({}, params), Error);
  params.thresholds = {};
  EXPECT_THROW(s.compare({}, params), Error);
  EXPECT_THROW(s.compare({s.primitive(0, 1100, 1201)}), Error);  // of a point too many
  other.cloud->labels.pop_back();
  EXPECT_THROW(other.compare({}), Error);
  // Without labels the truth's mesh is needed, and finite points.
  other.cloud->labels.clear();
  EXPECT_EQ(of(other.compare({}), "true"), 3);
  other.cloud->points[5].z() = std::nanf("");
  EXPECT_THROW(other.compare({}), Error);
  other.cloud->points[5].z() = 0;
  other.truth.mesh.primitives[1] = 3;
  EXPECT_THROW(other.compare({}), Error);
  other.truth.mesh.primitives.clear();
  EXPECT_THROW(other.compare({}), Error);
  // A cloud without points has no true regions: shares are not defined.
  other.cloud->points.clear();
  other.truth.mesh = {};
  const auto none = other.compare({});
  EXPECT_EQ(of(none, "true"), 0);
  EXPECT_FALSE(has(none, "primitives.t80.recall"));
  EXPECT_FALSE(has(none, "primitives.coverage"));
}

TEST(RegionOverlap, TheBestExplanationIsTakenOnce) {
  // Found 0 has all of face 0 (100) and 90 of face 1; found 1 the other 10. At one half: found 0 is both correct for
  // face 0 (shares 1 and 0.53) and a merge of both (0.95 and 1): the merge explains more, found 1 is noise.
  const Regions regions{{100, 100}, {190, 10}, {{0, 0, 100}, {1, 0, 90}, {1, 1, 10}}};
  const auto half = compare_regions(regions, 0.5);
  EXPECT_EQ(half.undersegmented, 1U);
  EXPECT_EQ(half.correct.size(), 0U);
  EXPECT_EQ(half.noise, 1U);
  EXPECT_EQ(half.missed, 0U);
  // Above 95 % face 1 is no part of the merge any more.
  const auto strict = compare_regions(regions, 0.95);
  EXPECT_EQ(strict.undersegmented, 0U);
  EXPECT_EQ(strict.missed, 2U);
  EXPECT_EQ(strict.noise, 2U);
}

}  // namespace
}  // namespace atrium::metric::primitives_test
