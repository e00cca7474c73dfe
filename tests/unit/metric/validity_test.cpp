#include "modules/metric/validity.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Geometry>
#include <cmath>
#include <set>

#include "graph/api/random.hpp"
#include "modules/synth/attic.hpp"
#include "modules/synth/flat.hpp"
#include "modules/synth/room.hpp"
#include "modules/synth/two_storeys.hpp"
#include "solids.hpp"

namespace atrium::metric::validity_test {
namespace {

using V = Eigen::Vector3d;

double of(const Metrics& m, const std::string& name) { return value(m, "validity." + name); }

TEST(MetricValidity, ABoxIsWatertight) {
  const auto m = validity(box(V(1, 2, 3), V(3, 5, 4)));
  expect_clean(m);
  EXPECT_EQ(of(m, "components.all"), 1);
  EXPECT_EQ(of(m, "components.closed_area"), 1);
  EXPECT_NEAR(of(m, "component_1.volume"), 6, 1e-12);
  EXPECT_NEAR(of(m, "component_1.area"), 22, 1e-12);
  // A room is a box seen from inside, its faces are not indexed together: welded by position it is closed.
  const auto inside = validity(room());
  expect_clean(inside);
  EXPECT_NEAR(of(inside, "component_1.volume"), -50, 1e-12);
}

TEST(MetricValidity, AMissingFaceOpensIt) {
  Mesh open = box();
  open.triangles.resize(10);  // without the side x = 0
  const auto m = validity(open);
  EXPECT_EQ(of(m, "edges.boundary"), 4);
  EXPECT_EQ(of(m, "edges.boundary_length"), 4);
  EXPECT_EQ(of(m, "closed"), 0);
  EXPECT_EQ(of(m, "components.closed_area"), 0);
  EXPECT_EQ(of(m, "component_1.boundary_edges"), 4);
  EXPECT_FALSE(has(m, "validity.component_1.volume"));
  // A second, whole box beside it: one of two is closed, 6 of 11 square metres.
  add_box(open, V(5, 0, 0), V(6, 1, 1));
  const auto two = validity(open);
  EXPECT_EQ(of(two, "components.all"), 2);
  EXPECT_EQ(of(two, "components.watertight"), 1);
  EXPECT_NEAR(of(two, "components.closed_area"), 6.0 / 11, 1e-12);
  EXPECT_EQ(of(two, "component_1.watertight"), 1);
  EXPECT_EQ(of(two, "component_2.closed"), 0);
  EXPECT_EQ(of(two, "closed"), 0);
}

TEST(MetricValidity, ADoubledFace) {
  Mesh doubled = box();
  doubled.triangles.push_back({doubled.triangles[0][1], doubled.triangles[0][0], doubled.triangles[0][2]});
  const auto m = validity(doubled);
  EXPECT_EQ(of(m, "duplicate_faces"), 1);
  EXPECT_EQ(of(m, "edges.non_manifold"), 3);
  EXPECT_EQ(of(m, "self_intersections.overlapping"), 0);
  EXPECT_EQ(of(m, "closed"), 1);
  EXPECT_EQ(of(m, "watertight"), 0);
}

TEST(MetricValidity, DegenerateFacesCountOnlyAsSuch) {
  Mesh mesh = box();
  mesh.triangles.push_back({0, 0, 1});
  mesh.vertices.emplace_back(V(0.5, 0, 0));  // on the edge from 0 to 1
  mesh.triangles.push_back({0, 8, 1});
  mesh.vertices.emplace_back(V(0.5, 1e-17, 0));  // as good as on it, but not exactly
  mesh.triangles.push_back({0, 9, 1});
  const auto m = validity(mesh);
  EXPECT_EQ(of(m, "degenerate_faces"), 2);
  EXPECT_EQ(of(m, "edges.non_manifold"), 1);  // the thin one's
  EXPECT_EQ(of(m, "edges.boundary"), 2);
}

TEST(MetricValidity, BoxesThatTouch) {
  // Along an edge, each with its own vertices: four faces at one edge; both its ends hang together over it.
  Mesh edge = box();
  add_box(edge, V(1, 1, 0), V(2, 2, 1));
  auto m = validity(edge);
  EXPECT_EQ(of(m, "edges.non_manifold"), 1);
  EXPECT_EQ(of(m, "vertices.non_manifold"), 0);
  EXPECT_EQ(of(m, "components.all"), 1);
  EXPECT_EQ(of(m, "edges.boundary"), 0);
  EXPECT_EQ(of(m, "self_intersections.crossing"), 0);
  // In a corner.
  Mesh corner = box();
  add_box(corner, V(1, 1, 1), V(2, 2, 2));
  m = validity(corner);
  EXPECT_EQ(of(m, "edges.non_manifold"), 0);
  EXPECT_EQ(of(m, "vertices.non_manifold"), 1);
  EXPECT_EQ(of(m, "components.all"), 2);
  EXPECT_EQ(of(m, "closed"), 1);
  EXPECT_EQ(of(m, "watertight"), 0);
  // Side by side: the common side is there twice, cut along its two diagonals, so that each half overlaps both of the
  // other; its border has four faces at each edge.
  Mesh side = box();
  add_box(side, V(1, 0, 0), V(2, 1, 1));
  m = validity(side);
  EXPECT_EQ(of(m, "duplicate_faces"), 0);
  EXPECT_EQ(of(m, "self_intersections.overlapping"), 4);
  EXPECT_EQ(of(m, "self_intersections.crossing"), 0);
  EXPECT_EQ(of(m, "edges.non_manifold"), 4);
  EXPECT_EQ(of(m, "components.all"), 1);
}

TEST(MetricValidity, ATJunctionIsOpenAndTouches) {
  // Two squares side by side, the right one cut at half its height: at x = 1 stand one long and two short edges.
  Mesh mesh;
  mesh.vertices = {V(0, 0, 0), V(1, 0, 0), V(1, 1, 0), V(0, 1, 0), V(2, 0, 0), V(2, 1, 0), V(1, 0.5, 0)};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 6}, {4, 5, 6}, {5, 2, 6}};
  const auto m = validity(mesh);
  EXPECT_EQ(of(m, "edges.boundary"), 3 + 3 + 3);  // three at the junction, three on each outside
  EXPECT_EQ(of(m, "self_intersections.crossing"), 0);
  EXPECT_EQ(of(m, "self_intersections.overlapping"), 0);
  // The long edge's triangle touches all three beyond: two lie along it with an edge, one with a corner.
  EXPECT_EQ(of(m, "self_intersections.touching"), 3);
  EXPECT_EQ(of(m, "self_intersections.faces"), 4);
  EXPECT_EQ(of(m, "self_intersections.through_edges"), 0);
  EXPECT_EQ(of(m, "components.all"), 2);
  EXPECT_EQ(of(m, "vertices.non_manifold"), 2);  // both ends of the junction: nothing joins the sides
}

TEST(MetricValidity, AFaceTurnedRound) {
  Mesh mesh = box();
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  const auto m = validity(mesh);
  EXPECT_EQ(of(m, "edges.misoriented"), 3);
  EXPECT_EQ(of(m, "closed"), 1);
  EXPECT_EQ(of(m, "watertight"), 0);
}

TEST(MetricValidity, ToleranceWeldsWhatNearlyMeets) {
  Mesh mesh = room();
  Random random(4);
  for (auto& v : mesh.vertices)
    for (int k = 0; k < 3; ++k) v[k] += random.uniform(-1e-4, 1e-4);
  EXPECT_EQ(of(validity(mesh), "closed"), 0);
  EXPECT_EQ(of(validity(mesh), "components.all"), 6);
  Validity::Params params;
  params.tolerance = 1e-3;
  expect_clean(validity(mesh, params));
  // Zeros of either sign are one place.
  Mesh zeros = room();
  for (std::size_t v = 0; v < zeros.vertices.size(); v += 2)
    for (int k = 0; k < 3; ++k)
      if (zeros.vertices[v][k] == 0) zeros.vertices[v][k] = -0.0;
  expect_clean(validity(zeros));
}

TEST(MetricValidity, EmptyAndBadMeshes) {
  const auto m = validity({});
  EXPECT_EQ(of(m, "triangles"), 0);
  EXPECT_EQ(of(m, "closed"), 0);
  EXPECT_EQ(of(m, "components.all"), 0);
  EXPECT_FALSE(has(m, "validity.components.closed_area"));
  Mesh bad = box();
  bad.vertices[3].y() = std::nan("");
  EXPECT_THROW(validity(bad), Error);
  bad.vertices[3].y() = 1e61;
  EXPECT_THROW(validity(bad), Error);
  bad = box();
  bad.triangles[0][2] = 8;
  EXPECT_THROW(validity(bad), Error);
}

TEST(MetricValidity, TruthOfScenesIsWhatItIs) {
  // One shell per room but for openings: nothing doubled, degenerate or inside out, nothing crosses.
  Context context;
  const auto check = [](const GroundTruth& truth) {
    const auto m = validity(truth.mesh);
    EXPECT_EQ(of(m, "duplicate_faces"), 0);
    EXPECT_EQ(of(m, "edges.misoriented"), 0);
    EXPECT_EQ(of(m, "edges.non_manifold"), 0);
    EXPECT_EQ(of(m, "self_intersections.deep"), 0);
    EXPECT_EQ(of(m, "self_intersections.overlapping"), 0);
    EXPECT_GT(of(m, "edges.boundary"), 0);  // windows and doors
  };
  check(synth::Room::run({}, context).scene.truth);
  check(synth::Flat::run({}, context).scene.truth);
  check(synth::TwoStoreys::run({}, context).scene.truth);
  check(synth::Attic::run({}, context).scene.truth);
}

TEST(MetricValidity, AnLShapedSolidIsClean) {
  // Its sides cut into triangles by their corners: nothing touches but along common edges, turned any way.
  const std::array<V, 6> plan{V(0, 0, 0), V(4, 0, 0), V(4, 2, 0), V(2, 2, 0), V(2, 5, 0), V(0, 5, 0)};
  Mesh mesh;
  for (const double z : {0.0, 2.5})
    for (const auto& p : plan) mesh.vertices.emplace_back(p.x(), p.y(), z);
  for (const auto& [p, q, r] : {std::array{0U, 1U, 3U}, {1U, 2U, 3U}, {0U, 3U, 5U}, {3U, 4U, 5U}}) {
    mesh.triangles.push_back({p, r, q});
    mesh.triangles.push_back({6 + p, 6 + q, 6 + r});
  }
  for (std::uint32_t k = 0; k < 6; ++k) {
    const std::uint32_t n = (k + 1) % 6;
    mesh.triangles.push_back({k, n, 6 + n});
    mesh.triangles.push_back({k, 6 + n, 6 + k});
  }
  expect_clean(validity(mesh));
  EXPECT_NEAR(of(validity(mesh), "component_1.volume"), 14 * 2.5, 1e-12);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, V(3, 2, 1).normalized()).toRotationMatrix();
  for (auto& v : mesh.vertices) v = turn * v + V(10, 20, -3);
  const auto m = validity(mesh);
  EXPECT_EQ(of(m, "self_intersections.deep"), 0);
  EXPECT_EQ(of(m, "closed"), 1);
}

RC_GTEST_PROP(MetricValidity, OrderOfTrianglesAndMotionsChangeNothing, (std::uint32_t seed)) {
  // Random soup on a raster: neighbours, duplicates, overlaps, crossings all occur.
  Random random(seed);
  Mesh mesh;
  for (int i = 0; i < 30; ++i)
    mesh.vertices.emplace_back(std::floor(random.uniform(0, 3)), std::floor(random.uniform(0, 3)),
                               std::floor(random.uniform(0, 3)));
  const auto vertex = [&] { return static_cast<std::uint32_t>(random.uniform(0, 30)); };
  for (int i = 0; i < 40; ++i) mesh.triangles.push_back({vertex(), vertex(), vertex()});
  Mesh other = mesh;
  for (std::size_t i = other.triangles.size(); i > 1; --i)
    std::swap(other.triangles[i - 1], other.triangles[static_cast<std::size_t>(random.uniform(0, 1) * i)]);
  for (auto& t : other.triangles) std::rotate(t.begin(), t.begin() + 1, t.end());
  // A motion that keeps the raster is exact: turned by 90° about z, and shifted by whole metres.
  for (auto& v : other.vertices) v = V(-v.y() + 17, v.x() - 5, v.z() + 2);
  const auto a = validity(mesh), b = validity(other);
  for (const auto& m : a.values)
    if (m.name.find("component_") == std::string::npos) RC_ASSERT(std::abs(value(b, m.name) - m.value) < 1e-9);
}

TEST(MetricValidity, SameBytesWithAnyNumberOfThreads) {
  Context context;
  const Mesh mesh = synth::Flat::run({}, context).scene.truth.mesh;
  std::set<std::string> hashes;
  for (const std::size_t threads : {1, 2, 4}) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    hashes.insert(content_hash(validity(mesh)));
  }
  EXPECT_EQ(hashes.size(), 1U);
}

}  // namespace
}  // namespace atrium::metric::validity_test
