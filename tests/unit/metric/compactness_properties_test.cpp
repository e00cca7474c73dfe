#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

#include "graph/api/random.hpp"
#include "meshes.hpp"
#include "modules/metric/compactness.hpp"

namespace atrium::metric::compactness_properties_test {
namespace {

using V = Eigen::Vector3d;

/// Closed rooms with convex outlines of 3 to 9 corners, as light as can be, and their truth.
struct Rooms {
  Mesh mesh;
  GroundTruth truth;
  std::size_t corners = 0, faces = 0;

  explicit Rooms(Random& random) {
    const auto rooms = 1 + random.index(3);
    for (std::uint64_t r = 0; r < rooms; ++r)
      add_room(V(10.0 * static_cast<double>(r), 0, 0), 3 + random.index(7), random);
    truth.mesh = mesh;
  }
  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c, SurfaceClass surface) {
    mesh.triangles.push_back({a, b, c});
    mesh.classes.push_back(surface);
    mesh.primitives.push_back(static_cast<std::int32_t>(faces));
  }
  void add_room(const V& middle, std::uint64_t n, Random& random) {
    // On a circle, not too near to each other: convex, and every corner leaves its neighbours' line by centimetres.
    const double height = random.uniform(2, 3), radius = random.uniform(2, 4), turn = random.uniform(0, 6);
    TrueRoom room{"room", 0, {}};
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size()), count = static_cast<std::uint32_t>(n);
    for (std::uint32_t k = 0; k < count; ++k) {
      const double angle = turn + (k + random.uniform(-0.25, 0.25)) * 2 * std::numbers::pi / count;
      room.outline.emplace_back(middle + radius * V(std::cos(angle), std::sin(angle), 0));
    }
    for (const double z : {0.0, height})
      for (const auto& p : room.outline) mesh.vertices.emplace_back(p + V(0, 0, z));
    for (std::uint32_t k = 1; k + 1 < count; ++k) add(first, first + k, first + k + 1, SurfaceClass::floor);
    ++faces;
    for (std::uint32_t k = 1; k + 1 < count; ++k)
      add(first + count, first + count + k + 1, first + count + k, SurfaceClass::ceiling);
    ++faces;
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t next = (k + 1) % count;
      add(first + k, first + count + next, first + next, SurfaceClass::wall);
      add(first + k, first + count + k, first + count + next, SurfaceClass::wall);
      ++faces;
    }
    corners += count;
    truth.rooms.push_back(room);
  }
};

Metrics compactness(const Mesh& mesh, const GroundTruth& truth) {
  Context context;
  return Compactness::run({input(mesh), OptionalInput<GroundTruth>(input(truth))}, {}, context).metrics;
}
double of(const Metrics& m, const std::string& name) { return value(m, "compactness." + name); }
bool same(const Metrics& a, const Metrics& b) {
  return a.values.size() == b.values.size() &&
         std::equal(a.values.begin(), a.values.end(), b.values.begin(), [](const Metric& x, const Metric& y) {
           return x.name == y.name && std::abs(x.value - y.value) < 1e-12;
         });
}

RC_GTEST_PROP(CompactnessProperties, ClosedRoomsAreTheLeast, (std::uint32_t seed)) {
  Random random(seed);
  const Rooms rooms(random);
  const auto m = compactness(rooms.mesh, rooms.truth);
  RC_ASSERT(of(m, "corners") == static_cast<double>(rooms.corners));
  RC_ASSERT(of(m, "triangles") == of(m, "least_triangles"));
  RC_ASSERT(of(m, "ratio") == 1);
  RC_ASSERT(of(m, "polygons") == static_cast<double>(rooms.faces));
}

RC_GTEST_PROP(CompactnessProperties, RigidMotionsChangeNothing, (std::uint32_t seed)) {
  Random random(seed);
  const Rooms rooms(random);
  Transform motion;
  motion.rotation =
      Eigen::AngleAxisd(random.uniform(-3, 3), V(random.normal(), random.normal(), 1).normalized()).toRotationMatrix();
  motion.translation = V(random.uniform(-1e6, 1e6), random.uniform(-1e6, 1e6), 0);
  RC_ASSERT(same(compactness(rooms.mesh, rooms.truth),
                 compactness(transformed(rooms.mesh, motion), transformed(rooms.truth, motion))));
}

RC_GTEST_PROP(CompactnessProperties, NamesAndOrderMeanNothing, (std::uint32_t seed)) {
  Random random(seed);
  const Rooms rooms(random);
  Mesh other = rooms.mesh;
  for (std::size_t i = other.triangles.size(); i > 1; --i) {
    const auto k = random.index(i);
    std::swap(other.triangles[i - 1], other.triangles[k]);
    std::swap(other.classes[i - 1], other.classes[k]);
    std::swap(other.primitives[i - 1], other.primitives[k]);
  }
  for (auto& t : other.triangles) std::rotate(t.begin(), t.begin() + static_cast<long>(random.index(3)), t.end());
  for (auto& p : other.primitives) p = 1000 - 3 * p;
  GroundTruth truth = rooms.truth;
  std::reverse(truth.rooms.begin(), truth.rooms.end());
  for (auto& room : truth.rooms) std::rotate(room.outline.begin(), room.outline.begin() + 1, room.outline.end());
  RC_ASSERT(same(compactness(rooms.mesh, rooms.truth), compactness(other, truth)));
}

RC_GTEST_PROP(CompactnessProperties, CutTrianglesAreMoreTrianglesAndTheSamePolygons, (std::uint32_t seed)) {
  Random random(seed);
  const Rooms rooms(random);
  Mesh cut;
  cut.vertices = rooms.mesh.vertices;
  for (std::size_t i = 0; i < rooms.mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = rooms.mesh.triangles[i];
    const auto middle = static_cast<std::uint32_t>(cut.vertices.size());
    cut.vertices.emplace_back((cut.vertices[a] + cut.vertices[b] + cut.vertices[c]) / 3);
    for (const auto& t : {std::array{a, b, middle}, {b, c, middle}, {c, a, middle}}) {
      cut.triangles.push_back(t);
      cut.classes.push_back(rooms.mesh.classes[i]);
      cut.primitives.push_back(rooms.mesh.primitives[i]);
    }
  }
  const auto m = compactness(cut, rooms.truth);
  RC_ASSERT(of(m, "ratio") == 3);
  RC_ASSERT(of(m, "polygons") == static_cast<double>(rooms.faces));
}

RC_GTEST_PROP(CompactnessProperties, DoubledFacesCountTwiceAndObjectsNever, (std::uint32_t seed)) {
  Random random(seed);
  const Rooms rooms(random);
  const auto before = compactness(rooms.mesh, rooms.truth);
  Mesh more = rooms.mesh;
  const auto t = random.index(rooms.mesh.triangles.size());
  more.triangles.push_back(more.triangles[t]);
  more.classes.push_back(more.classes[t]);
  more.primitives.push_back(more.primitives[t]);
  RC_ASSERT(of(compactness(more, rooms.truth), "triangles") == of(before, "triangles") + 1);
  RC_ASSERT(of(compactness(more, rooms.truth), "ratio") > 1);
  more.classes.back() = SurfaceClass::object;
  RC_ASSERT(same(before, compactness(more, rooms.truth)));
}

}  // namespace
}  // namespace atrium::metric::compactness_properties_test
