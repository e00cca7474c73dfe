#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <string>

#include "graph/api/random.hpp"
#include "meshes.hpp"
#include "modules/metric/structure.hpp"

namespace atrium::metric::structure_properties_test {
namespace {

using V = Eigen::Vector3d;

Structure::Out compare(const Mesh& mesh, const Mesh& truth) {
  Context context;
  Structure::Params params;
  params.spacing = 0.12;
  return Structure::run({input(mesh), {}, OptionalInput<Mesh>(input(truth))}, params, context);
}

/// A room of random size, its faces in the order floor, ceiling, walls.
Mesh any_room(Random& random) {
  const double x = random.uniform(1, 3), y = random.uniform(1, 3), z = random.uniform(1, 2.5);
  Mesh m;
  add_rectangle(m, V(0, 0, 0), V(x, 0, 0), V(0, y, 0), SurfaceClass::floor, 0);
  add_rectangle(m, V(0, 0, z), V(0, y, 0), V(x, 0, 0), SurfaceClass::ceiling, 1);
  add_rectangle(m, V(0, 0, 0), V(0, 0, z), V(x, 0, 0), SurfaceClass::wall, 2);
  add_rectangle(m, V(x, 0, 0), V(0, 0, z), V(0, y, 0), SurfaceClass::wall, 3);
  add_rectangle(m, V(x, y, 0), V(0, 0, z), V(-x, 0, 0), SurfaceClass::wall, 4);
  add_rectangle(m, V(0, y, 0), V(0, 0, z), V(0, -y, 0), SurfaceClass::wall, 5);
  return m;
}
Mesh without_triangles(const Mesh& mesh, const std::function<bool(std::size_t)>& gone) {
  Mesh rest;
  rest.vertices = mesh.vertices;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (gone(i)) continue;
    rest.triangles.push_back(mesh.triangles[i]);
    rest.classes.push_back(mesh.classes[i]);
  }
  return rest;
}
/// The room as it might be found: faces moved by up to 12 cm, one missing, one that is not there.
Mesh found(const Mesh& truth, Random& random) {
  Mesh mesh = truth;
  for (std::size_t face = 0; face < 6; ++face) {
    const V shift(random.uniform(-0.07, 0.07), random.uniform(-0.07, 0.07), random.uniform(-0.07, 0.07));
    for (std::size_t k = 0; k < 4; ++k) mesh.vertices[4 * face + k] += shift;
  }
  const auto missing = random.index(6);
  mesh = without_triangles(mesh, [&](std::size_t i) { return i / 2 == missing; });
  Mesh wall;
  add_rectangle(wall, V(0.5, random.uniform(0, 1), 0), V(0, 0, 1), V(1, 0, 0), SurfaceClass::wall, 6);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), wall.vertices.begin(), wall.vertices.end());
  for (auto t : wall.triangles) {
    for (auto& v : t) v += first;
    mesh.triangles.push_back(t);
    mesh.classes.push_back(SurfaceClass::wall);
  }
  return mesh;
}

/// A median may lie on either side of a gap if just as much is below as above it, up to rounding.
bool is_median(const Metric& m) { return m.name.find("accuracy") != std::string::npos; }
bool alike(const Metrics& a, const Metrics& b, double tolerance) {
  if (a.values.size() != b.values.size()) return false;
  for (const auto& m : a.values)
    if (!is_median(m) && !(std::abs(value(b, m.name) - m.value) <= tolerance)) return false;
  return true;
}
std::string swapped_name(std::string name) {
  const auto rename = [&](const std::string& from, const std::string& to) {
    const auto at = name.find(from);
    if (at == std::string::npos) return false;
    name.replace(at, from.size(), to);
    return true;
  };
  if (!rename("completeness", "correctness") && !rename("correctness", "completeness") && !rename("true", "recon"))
    rename("reconstructed", "true");
  rename("recon", "reconstructed");
  return name;
}

RC_GTEST_PROP(StructureProperties, TheTruthScoresAllOfItself, (std::uint32_t seed)) {
  Random random(seed);
  const Mesh truth = any_room(random);
  const auto out = compare(truth, truth);
  for (const auto* list : {&out.metrics, &out.curve})
    for (const auto& m : list->values) {
      if (m.unit.empty()) RC_ASSERT(m.value == 1);
      if (m.unit == "m") RC_ASSERT(m.value < 1e-12);
    }
}

RC_GTEST_PROP(StructureProperties, AWiderBufferNeverHoldsLess, (std::uint32_t seed)) {
  Random random(seed);
  const Mesh truth = any_room(random);
  const auto curve = compare(found(truth, random), truth).curve;
  for (const char* group : {"total", "wall", "floor", "ceiling"})
    for (const char* key : {"completeness", "correctness", "accuracy"}) {
      double last = 0;
      for (int step = 1; step <= 15; ++step) {
        const std::string name = std::string("structure_curve.") + group + (step < 10 ? ".b0" : ".b") +
                                 std::to_string(10 * step) + "mm." + key;
        if (!has(curve, name)) continue;
        RC_ASSERT(value(curve, name) >= last);
        last = value(curve, name);
      }
    }
}

RC_GTEST_PROP(StructureProperties, ExchangedSidesExchangeCompletenessAndCorrectness, (std::uint32_t seed)) {
  Random random(seed);
  const Mesh truth = any_room(random), mesh = found(truth, random);
  const auto forth = compare(mesh, truth).metrics, back = compare(truth, mesh).metrics;
  for (const auto& m : forth.values) {
    if (is_median(m)) continue;
    RC_ASSERT(std::abs(value(back, swapped_name(m.name)) - m.value) < 1e-9);
  }
}

RC_GTEST_PROP(StructureProperties, MoreSurfaceIsNeverLessComplete, (std::uint32_t seed)) {
  Random random(seed);
  const Mesh truth = any_room(random), mesh = found(truth, random);
  const auto all = compare(mesh, truth).metrics;
  const auto some =
      compare(without_triangles(mesh, [&](std::size_t) { return random.uniform() < 0.3; }), truth).metrics;
  for (const auto& m : all.values)
    if (m.name.find("completeness") != std::string::npos && has(some, m.name))
      RC_ASSERT(value(some, m.name) <= m.value + 1e-9);
}

RC_GTEST_PROP(StructureProperties, ADoubledSurfaceChangesNoShare, (std::uint32_t seed)) {
  Random random(seed);
  const Mesh truth = any_room(random), mesh = found(truth, random);
  Mesh twice = mesh;
  twice.triangles.insert(twice.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
  twice.classes.insert(twice.classes.end(), mesh.classes.begin(), mesh.classes.end());
  const auto once = compare(mesh, truth).metrics, doubled = compare(twice, truth).metrics;
  for (const auto& m : once.values) {
    if (is_median(m)) continue;
    const double factor = m.name.find("area.reconstructed") != std::string::npos ? 2 : 1;
    RC_ASSERT(std::abs(value(doubled, m.name) - factor * m.value) < 1e-9);
  }
}

RC_GTEST_PROP(StructureProperties, NamesAndOrderOfTrianglesAndVerticesMeanNothing, (std::uint32_t seed)) {
  Random random(seed);
  const Mesh truth = any_room(random), mesh = found(truth, random);
  Mesh other = mesh;
  for (std::size_t i = other.triangles.size(); i > 1; --i) {
    const auto k = random.index(i);
    std::swap(other.triangles[i - 1], other.triangles[k]);
    std::swap(other.classes[i - 1], other.classes[k]);
  }
  std::reverse(other.vertices.begin(), other.vertices.end());
  for (auto& t : other.triangles)
    for (auto& v : t) v = static_cast<std::uint32_t>(other.vertices.size()) - 1 - v;
  other.primitives.assign(other.triangles.size(), 7);
  other.storeys.assign(other.triangles.size(), -1);
  RC_ASSERT(alike(compare(mesh, truth).metrics, compare(other, truth).metrics, 1e-9));
}

RC_GTEST_PROP(StructureProperties, RigidMotionsOfBothSidesChangeNothing, (std::uint32_t seed)) {
  Random random(seed);
  const Mesh truth = any_room(random), mesh = found(truth, random);
  Transform motion;
  motion.rotation =
      Eigen::AngleAxisd(random.uniform(-3, 3), V(random.normal(), random.normal(), 1).normalized()).toRotationMatrix();
  motion.translation = V(random.uniform(-1e6, 1e6), random.uniform(-1e6, 1e6), random.uniform(-100, 100));
  // A sample of 0.0144 m² may lie on the edge of a buffer; the least class has 1 m².
  RC_ASSERT(alike(compare(mesh, truth).metrics, compare(transformed(mesh, motion), transformed(truth, motion)).metrics,
                  0.015));
}

}  // namespace
}  // namespace atrium::metric::structure_properties_test
