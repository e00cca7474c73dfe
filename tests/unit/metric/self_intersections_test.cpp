#include "modules/metric/self_intersections.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "graph/api/random.hpp"
#include "solids.hpp"

namespace atrium::metric::self_intersections_test {
namespace {

using V = Eigen::Vector3d;

double of(const Metrics& m, const std::string& name) { return value(m, "validity." + name); }

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

TEST(SelfIntersections, SharedCornersCount) {
  // With a common corner: crossing if they run through each other, not if they only meet there.
  const std::array<V, 3> a{V(0, 0, 0), V(2, 0, 0), V(0, 2, 0)};
  EXPECT_EQ(meeting(a, {V(0, 0, 0), V(1, 1, 1), V(1, 1, -1)}), Meeting::crossing);
  EXPECT_EQ(meeting(a, {V(0, 0, 0), V(1, 1, 1), V(-3, 0.5, -1)}), Meeting::apart);
  EXPECT_EQ(meeting(a, {V(0, 0, 0), V(-1, -1, 1), V(-1, -1, -1)}), Meeting::apart);
  EXPECT_EQ(meeting(a, {V(0, 0, 0), V(2, 0, 0), V(1, 1, 1)}), Meeting::apart);
}

}  // namespace
}  // namespace atrium::metric::self_intersections_test
