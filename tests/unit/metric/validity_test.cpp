#include "modules/metric/validity.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Geometry>
#include <set>

#include "graph/api/random.hpp"
#include "meshes.hpp"
#include "modules/metric/self_intersections.hpp"
#include "modules/synth/attic.hpp"
#include "modules/synth/flat.hpp"
#include "modules/synth/room.hpp"
#include "modules/synth/two_storeys.hpp"

namespace atrium::metric {
namespace {

using V = Eigen::Vector3d;

Metrics validity(const Mesh& mesh, const Validity::Params& params = {}) {
  Context context;
  return Validity::run({input(mesh)}, params, context).metrics;
}
double of(const Metrics& m, const std::string& name) { return value(m, "validity." + name); }

/// Twelve triangles that look outwards, eight shared vertices.
void add_box(Mesh& mesh, const V& low, const V& high) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int i = 0; i < 8; ++i)
    mesh.vertices.emplace_back((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                               (i & 4) != 0 ? high.z() : low.z());
  for (const auto& [a, b, c, d] : {std::array{0U, 2U, 3U, 1U},
                                   {4U, 5U, 7U, 6U},
                                   {0U, 1U, 5U, 4U},
                                   {1U, 3U, 7U, 5U},
                                   {3U, 2U, 6U, 7U},
                                   {2U, 0U, 4U, 6U}}) {
    mesh.triangles.push_back({first + a, first + b, first + c});
    mesh.triangles.push_back({first + a, first + c, first + d});
  }
}
Mesh box(const V& low = V::Zero(), const V& high = V::Ones()) {
  Mesh mesh;
  add_box(mesh, low, high);
  return mesh;
}
void expect_clean(const Metrics& m) {
  for (const char* name :
       {"degenerate_faces", "duplicate_faces", "edges.boundary", "edges.non_manifold", "edges.misoriented",
        "vertices.non_manifold", "self_intersections.crossing", "self_intersections.overlapping",
        "self_intersections.touching", "self_intersections.through_edges"})
    EXPECT_EQ(of(m, name), 0) << name;
  EXPECT_EQ(of(m, "watertight"), 1);
}

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

TEST(MetricValidity, AWallThatStandsOnAFloorTouchesItButOneThroughItCrosses) {
  Mesh mesh;
  add_rectangle(mesh, V(0, 0, 0), V(4, 0, 0), V(0, 4, 0), SurfaceClass::floor, 0);
  add_rectangle(mesh, V(1, 2.5, 0), V(0.5, 0, 0), V(0, 0, 2), SurfaceClass::wall, 1);
  EXPECT_EQ(of(validity(mesh), "self_intersections.crossing"), 0);
  EXPECT_EQ(of(validity(mesh), "self_intersections.touching"), 2);  // one with an edge, one with a corner
  EXPECT_EQ(of(validity(mesh), "self_intersections.through_edges"), 0);
  // One centimetre deeper it goes through one of the floor's triangles, with both of its own.
  mesh.vertices[4].z() = mesh.vertices[5].z() = -0.01;
  const auto m = validity(mesh);
  EXPECT_EQ(of(m, "self_intersections.crossing"), 2);
  EXPECT_EQ(of(m, "self_intersections.deep"), 2);
  EXPECT_EQ(of(m, "self_intersections.faces"), 3);
  Validity::Params params;
  params.depth = 0.011;
  EXPECT_EQ(of(validity(mesh, params), "self_intersections.deep"), 0);
  // By the least number that there is.
  mesh.vertices[4].z() = mesh.vertices[5].z() = -1e-30;
  EXPECT_EQ(of(validity(mesh), "self_intersections.crossing"), 2);
  EXPECT_EQ(of(validity(mesh), "self_intersections.deep"), 0);
}

TEST(MetricValidity, OverlappingFacesInOnePlane) {
  Mesh mesh;
  mesh.vertices = {V(0, 0, 1), V(2, 0, 1), V(0, 2, 1), V(0.5, 0.5, 1), V(3, 0.5, 1), V(0.5, 3, 1)};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  EXPECT_EQ(of(validity(mesh), "self_intersections.overlapping"), 1);
  // Folded back over their common edge they overlap; unfolded they do not.
  mesh.vertices = {V(0, 0, 1), V(2, 0, 1), V(0, 2, 1), V(1, 1.5, 1), V(1, -1.5, 1)};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
  EXPECT_EQ(of(validity(mesh), "self_intersections.overlapping"), 1);
  mesh.triangles = {{0, 1, 2}, {1, 0, 4}};
  EXPECT_EQ(of(validity(mesh), "self_intersections.overlapping"), 0);
  // One inside the other, touching nowhere.
  mesh.vertices = {V(0, 0, 0), V(8, 0, 8), V(0, 8, 0), V(1, 1, 1), V(2, 1, 2), V(1, 2, 1)};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  EXPECT_EQ(of(validity(mesh), "self_intersections.overlapping"), 1);
}

TEST(MetricValidity, AFaceTurnedRound) {
  Mesh mesh = box();
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  const auto m = validity(mesh);
  EXPECT_EQ(of(m, "edges.misoriented"), 3);
  EXPECT_EQ(of(m, "closed"), 1);
  EXPECT_EQ(of(m, "watertight"), 0);
}

TEST(MetricValidity, BoxesThatCrossAtACorner) {
  // The corner of one box in the other: three faces of each meet in a ring of six segments. Two of them run over a
  // diagonal of the first box's faces (y = z on x = 2, x = y on z = 2), two over one of the second's (on its faces
  // y = 0.9 and z = 1.2), and each such place adds a pair of triangles.
  Mesh mesh = box(V(0, 0, 0), V(2, 2, 2));
  add_box(mesh, V(1, 0.9, 1.2), V(3, 3.3, 2.7));
  const auto m = validity(mesh);
  EXPECT_EQ(of(m, "self_intersections.crossing"), 10);
  EXPECT_EQ(of(m, "self_intersections.overlapping"), 0);
  EXPECT_EQ(of(m, "components.all"), 2);
  EXPECT_EQ(of(m, "closed"), 1);
  EXPECT_EQ(of(m, "components.watertight"), 0);
  // Turned, every number is rounded; nothing else changes.
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, V(1, 2, 3).normalized()).toRotationMatrix();
  for (auto& v : mesh.vertices) v = turn * v + V(100, -50, 3);
  const auto turned = validity(mesh);
  EXPECT_EQ(of(turned, "self_intersections.crossing"), 10);
  EXPECT_EQ(of(turned, "self_intersections.deep"), of(m, "self_intersections.deep"));
  EXPECT_NEAR(of(turned, "component_1.volume"), of(m, "component_1.volume"), 1e-9);
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
  check(synth::Room::run({}, {}, context).scene.truth);
  check(synth::Flat::run({}, {}, context).scene.truth);
  check(synth::TwoStoreys::run({}, {}, context).scene.truth);
  check(synth::Attic::run({}, {}, context).scene.truth);
}

TEST(SelfIntersections, AgreeWithSampledTrianglesWhereNothingIsNear) {
  // Random pairs, away from contact: the exact answer is that of a segment clipped in doubles.
  Random random(8);
  int crossing = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto any = [&] { return V(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)); };
    const std::array<V, 3> a{any(), any(), any()}, b{any(), any(), any()};
    const auto pierces = [](const std::array<V, 3>& edges, const std::array<V, 3>& face) {
      const V n = (face[1] - face[0]).cross(face[2] - face[0]);
      for (std::size_t k = 0; k < 3; ++k) {
        const V p = edges[k], q = edges[(k + 1) % 3];
        const double dp = n.dot(p - face[0]), dq = n.dot(q - face[0]);
        if (dp * dq >= 0) continue;
        const V x = p + (q - p) * (dp / (dp - dq));
        bool inside = true;
        for (std::size_t e = 0; e < 3; ++e)
          inside = inside && n.dot((face[(e + 1) % 3] - face[e]).cross(x - face[e])) > 0;
        if (inside) return true;
      }
      return false;
    };
    const bool expected = pierces(a, b) || pierces(b, a);
    ASSERT_EQ(meeting(a, b) == Meeting::crossing, expected) << i;
    ASSERT_EQ(meeting(b, a) == Meeting::crossing, expected);
    ASSERT_EQ(meeting({a[2], a[1], a[0]}, {b[1], b[2], b[0]}) == Meeting::crossing, expected);
    crossing += expected ? 1 : 0;
  }
  EXPECT_GT(crossing, 1000);
}

TEST(MetricValidity, AColumnThroughASlabCutAtItsFaces) {
  // The column's faces end where the slab's begin: no two faces cross, yet it goes through.
  const auto slab_and = [](const auto& add_column) {
    Mesh mesh = box(V(0, 0, 1), V(5, 4, 2));
    add_column(mesh);
    return validity(mesh);
  };
  const auto column = [](Mesh& mesh, const std::vector<double>& heights, double x, double y, double width) {
    // A tube of four sides, cut at the heights, and two lids.
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const double z : heights)
      for (const auto& [right, back] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
        mesh.vertices.emplace_back(x + right * width, y + back * width, z);
    const auto at = [&](std::size_t level, std::size_t k) {
      return static_cast<std::uint32_t>(first + 4 * level + k % 4);
    };
    for (std::size_t level = 0; level + 1 < heights.size(); ++level)
      for (std::size_t k = 0; k < 4; ++k) {
        mesh.triangles.push_back({at(level, k), at(level, k + 1), at(level + 1, k + 1)});
        mesh.triangles.push_back({at(level, k), at(level + 1, k + 1), at(level + 1, k)});
      }
    const auto top = heights.size() - 1;
    mesh.triangles.insert(mesh.triangles.end(), {{at(0, 0), at(0, 2), at(0, 1)}, {at(0, 0), at(0, 3), at(0, 2)}});
    mesh.triangles.insert(mesh.triangles.end(),
                          {{at(top, 0), at(top, 1), at(top, 2)}, {at(top, 0), at(top, 2), at(top, 3)}});
  };
  auto m = slab_and([&](Mesh& mesh) { column(mesh, {0, 1, 2, 3}, 3, 1, 0.5); });
  EXPECT_EQ(of(m, "self_intersections.crossing"), 0);
  EXPECT_EQ(of(m, "self_intersections.overlapping"), 0);
  EXPECT_EQ(of(m, "self_intersections.through_edges"), 8);
  EXPECT_GE(of(m, "self_intersections.touching"), 16);
  EXPECT_EQ(of(m, "closed"), 1);
  EXPECT_EQ(of(m, "components.watertight"), 0);
  // Cut elsewhere, the same solids cross.
  m = slab_and([&](Mesh& mesh) { column(mesh, {0, 1.5, 3}, 3, 1, 0.5); });
  EXPECT_GE(of(m, "self_intersections.crossing"), 8);
  EXPECT_EQ(of(m, "self_intersections.through_edges"), 0);
  EXPECT_EQ(of(m, "components.watertight"), 0);
  // Beside it, nothing is wrong.
  m = slab_and([&](Mesh& mesh) { column(mesh, {0, 1, 2, 3}, 6, 1, 0.5); });
  expect_clean(m);
}

TEST(MetricValidity, WedgesThatPassThroughEachOtherAlongTheirEdges) {
  // Two roofs, one upside down, with their ridges on one line: half-planes that take turns pass through, others touch.
  const auto prism = [](Mesh& mesh, const std::array<V, 3>& section, double from, double to) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const double y : {from, to})
      for (const auto& p : section) mesh.vertices.emplace_back(p.x(), y, p.z());
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t n = (k + 1) % 3;
      mesh.triangles.push_back({first + k, first + n, first + 3 + n});
      mesh.triangles.push_back({first + k, first + 3 + n, first + 3 + k});
    }
    mesh.triangles.push_back({first, first + 2, first + 1});
    mesh.triangles.push_back({first + 3, first + 4, first + 5});
  };
  Mesh touching;
  prism(touching, {V(0, 0, 0), V(-1, 0, -1), V(1, 0, -1)}, 0, 4);
  prism(touching, {V(0, 0, 0), V(1, 0, 1), V(-1, 0, 1)}, 1, 3);
  auto m = validity(touching);
  EXPECT_EQ(of(m, "self_intersections.crossing"), 0);
  EXPECT_EQ(of(m, "self_intersections.through_edges"), 0);
  EXPECT_GT(of(m, "self_intersections.touching"), 0);
  EXPECT_EQ(of(m, "closed"), 1);
  EXPECT_EQ(of(m, "components.watertight"), 0);
  // One that starts at the ridge and goes down on one side only, beyond the other roof's side: its end triangles cross
  // the other roof's side at most where it passes through.
  Mesh through;
  prism(through, {V(0, 0, 0), V(-1, 0, -1), V(1, 0, -1)}, 0, 4);
  prism(through, {V(0, 0, 0), V(0, 0, -0.5), V(2, 0, -0.5)}, 1, 3);
  m = validity(through);
  EXPECT_EQ(of(m, "self_intersections.through_edges"), 2);
  EXPECT_GT(of(m, "self_intersections.crossing"), 0);
}

RC_GTEST_PROP(MetricValidity, ValidSolidsAreCleanAndBoxesPassThroughWhereTheyShould, (std::uint32_t seed)) {
  Random random(seed);
  const auto whole = [&](double below) { return std::floor(random.uniform(0, below)); };
  const auto any_box = [&](V& low, V& high) {
    for (int k = 0; k < 3; ++k) {
      low[k] = whole(4);
      high[k] = low[k] + 1 + whole(3);
    }
  };
  V a, b, c, d;
  any_box(a, b);
  any_box(c, d);
  expect_clean(validity(box(a, b)));
  Mesh mesh = box(a, b);
  add_box(mesh, c, d);
  const auto m = validity(mesh);
  const double passing = of(m, "self_intersections.crossing") + of(m, "self_intersections.overlapping") +
                         of(m, "self_intersections.through_edges") + of(m, "edges.non_manifold");
  const bool inside_out = (a.array() < d.array()).all() && (c.array() < b.array()).all();
  const auto holds = [](const V& low, const V& high, const V& p, const V& q) {
    return (low.array() <= p.array()).all() && (q.array() <= high.array()).all();
  };
  const bool nested = holds(a, b, c, d) || holds(c, d, a, b);
  const bool disjoint = (a.array() > d.array()).any() || (c.array() > b.array()).any();
  if (inside_out && !nested) RC_ASSERT(passing > 0);
  if (!inside_out || nested) RC_ASSERT(of(m, "self_intersections.crossing") == 0);
  if (disjoint) {
    RC_ASSERT(of(m, "self_intersections.faces") == 0);
    RC_ASSERT(of(m, "watertight") == 1);
  } else if (!nested) {
    RC_ASSERT(of(m, "watertight") == 0);
  }
  RC_CLASSIFY(inside_out && !nested, "passing");
  RC_CLASSIFY(disjoint, "disjoint");
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

TEST(SelfIntersections, SharedCornersCount) {
  // With a common corner: crossing if they run through each other, not if they only meet there.
  const std::array<V, 3> a{V(0, 0, 0), V(2, 0, 0), V(0, 2, 0)};
  EXPECT_EQ(meeting(a, {V(0, 0, 0), V(1, 1, 1), V(1, 1, -1)}), Meeting::crossing);
  EXPECT_EQ(meeting(a, {V(0, 0, 0), V(1, 1, 1), V(-3, 0.5, -1)}), Meeting::apart);
  EXPECT_EQ(meeting(a, {V(0, 0, 0), V(-1, -1, 1), V(-1, -1, -1)}), Meeting::apart);
  EXPECT_EQ(meeting(a, {V(0, 0, 0), V(2, 0, 0), V(1, 1, 1)}), Meeting::apart);
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
  const Mesh mesh = synth::Flat::run({}, {}, context).scene.truth.mesh;
  std::set<std::string> hashes;
  for (const std::size_t threads : {1, 2, 4}) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    hashes.insert(content_hash(validity(mesh)));
  }
  EXPECT_EQ(hashes.size(), 1U);
}

}  // namespace
}  // namespace atrium::metric
