#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "graph/api/random.hpp"
#include "meshes.hpp"
#include "modules/metric/primitives.hpp"

namespace atrium::metric::primitives_properties_test {
namespace {

using V = Eigen::Vector3d;

/// Labelled points of 2 to 6 rectangles in any position, and the planes that a perfect method would find.
struct Scene {
  GroundTruth truth;
  std::shared_ptr<Cloud> cloud = std::make_shared<Cloud>();
  std::vector<PlanePrimitive> planes;

  explicit Scene(Random& random) {
    const auto faces = static_cast<std::int32_t>(2 + random.index(5));
    for (std::int32_t f = 0; f < faces; ++f) {
      const auto any = [&](double far) {
        return V(random.uniform(-far, far), random.uniform(-far, far), random.uniform(-far, far));
      };
      const V corner = any(5), a = any(1).normalized() * random.uniform(1, 3);
      const V b = a.cross(any(1)).normalized() * random.uniform(1, 3);
      TrueFace face;
      face.plane.normal = a.cross(b).normalized();
      face.plane.offset = -face.plane.normal.dot(corner);
      face.outline = {corner, corner + a, corner + a + b, corner + b};
      truth.faces.push_back(face);
      add_rectangle(truth.mesh, corner, a, b, SurfaceClass::wall, f);
      PlanePrimitive plane;
      plane.plane = face.plane;
      const auto points = 60 + random.index(100);
      for (std::uint64_t i = 0; i < points; ++i) {
        plane.inliers.push_back(static_cast<std::uint32_t>(cloud->points.size()));
        cloud->points.emplace_back((corner + random.uniform() * a + random.uniform() * b).cast<float>());
        cloud->labels.push_back(f);
      }
      planes.push_back(plane);
    }
  }
  /// As a method might find them: each point goes astray by chance, and some planes are split or merged.
  std::vector<PlanePrimitive> found(Random& random) const {
    std::vector<PlanePrimitive> result = planes;
    for (auto& plane : result) plane.inliers.clear();
    for (std::uint32_t i = 0; i < cloud->size(); ++i) {
      const auto own = static_cast<std::size_t>(cloud->labels[i]);
      result[random.uniform() < 0.15 ? random.index(result.size()) : own].inliers.push_back(i);
    }
    return result;
  }
};

Metrics compare(const Scene& scene, const std::vector<PlanePrimitive>& planes) {
  Context context;
  return Primitives::run({input(PlanePrimitives{scene.cloud, planes}), input(scene.truth)}, {}, context).metrics;
}
double of(const Metrics& m, const std::string& name) { return value(m, "primitives." + name); }
bool alike(const Metrics& a, const Metrics& b, double tolerance) {
  if (a.values.size() != b.values.size()) return false;
  for (std::size_t i = 0; i < a.values.size(); ++i)
    if (a.values[i].name != b.values[i].name || !(std::abs(a.values[i].value - b.values[i].value) <= tolerance))
      return false;
  return true;
}
/// Planes i and k as one, with the plane of i.
std::vector<PlanePrimitive> merged(std::vector<PlanePrimitive> planes, std::size_t i, std::size_t k) {
  auto& into = planes[i].inliers;
  into.insert(into.end(), planes[k].inliers.begin(), planes[k].inliers.end());
  std::sort(into.begin(), into.end());
  planes.erase(planes.begin() + static_cast<long>(k));
  return planes;
}

RC_GTEST_PROP(PrimitivesProperties, TheTruthScoresAllOfItself, (std::uint32_t seed)) {
  Random random(seed);
  const Scene scene(random);
  const auto m = compare(scene, scene.planes);
  for (const char* t : {"t50.", "t80."}) {
    RC_ASSERT(of(m, std::string(t) + "recall") == 1);
    RC_ASSERT(of(m, std::string(t) + "precision") == 1);
    for (const char* wrong : {"oversegmented", "undersegmented", "missed", "noise"})
      RC_ASSERT(of(m, std::string(t) + wrong) == 0);
  }
  RC_ASSERT(of(m, "purity") == 1);
  RC_ASSERT(of(m, "coverage") == 1);
  RC_ASSERT(of(m, "normal_error.max") < 1e-6);
  RC_ASSERT(of(m, "offset_error.max") < 1e-9);
}

RC_GTEST_PROP(PrimitivesProperties, NamesOfPlanesAndFacesMeanNothing, (std::uint32_t seed)) {
  Random random(seed);
  const Scene scene(random);
  auto planes = scene.found(random);
  const auto before = compare(scene, planes);
  for (std::size_t i = planes.size(); i > 1; --i) std::swap(planes[i - 1], planes[random.index(i)]);
  RC_ASSERT(alike(before, compare(scene, planes), 1e-9));
  // Faces in another order, labels with them.
  Scene other = scene;
  other.cloud = std::make_shared<Cloud>(*scene.cloud);
  const auto last = static_cast<std::int32_t>(scene.truth.faces.size()) - 1;
  std::reverse(other.truth.faces.begin(), other.truth.faces.end());
  for (auto* column : {&other.cloud->labels, &other.truth.mesh.primitives})
    for (auto& f : *column) f = last - f;
  RC_ASSERT(alike(before, compare(other, planes), 1e-9));
}

RC_GTEST_PROP(PrimitivesProperties, RigidMotionsOfBothSidesChangeNothing, (std::uint32_t seed)) {
  Random random(seed);
  const Scene scene(random);
  Transform motion;
  motion.rotation =
      Eigen::AngleAxisd(random.uniform(-3, 3), V(random.normal(), random.normal(), 1).normalized()).toRotationMatrix();
  motion.translation = V(random.uniform(-1e6, 1e6), random.uniform(-1e6, 1e6), random.uniform(-100, 100));
  const PlanePrimitives planes{scene.cloud, scene.found(random)};
  Context context;
  const auto moved =
      Primitives::run({input(transformed(planes, motion)), input(transformed(scene.truth, motion))}, {}, context);
  // Points are of single precision, planes of double: counts and shares stay, errors to a micrometre and less.
  RC_ASSERT(alike(compare(scene, planes.primitives), moved.metrics, 1e-5));
}

RC_GTEST_PROP(PrimitivesProperties, MergedPlanesAreNeverPurer, (std::uint32_t seed)) {
  Random random(seed);
  const Scene scene(random);
  const auto planes = scene.found(random);
  const auto k = 1 + random.index(planes.size() - 1);
  const auto apart = compare(scene, planes), together = compare(scene, merged(planes, 0, k));
  RC_ASSERT(of(together, "purity") <= of(apart, "purity") + 1e-12);
  RC_ASSERT(of(together, "coverage") <= of(apart, "coverage") + 1e-12);
  RC_ASSERT(of(together, "found") == of(apart, "found") - 1);
}

RC_GTEST_PROP(PrimitivesProperties, EveryRegionIsCountedOnceAtMost, (std::uint32_t seed)) {
  Random random(seed);
  const Scene scene(random);
  const auto m = compare(scene, scene.found(random));
  for (const std::string t : {"t50.", "t80."}) {
    const double single = of(m, t + "correct") + of(m, t + "oversegmented") + of(m, t + "missed");
    RC_ASSERT(single + 2 * of(m, t + "undersegmented") <= of(m, "true"));
    RC_ASSERT(of(m, t + "correct") + of(m, t + "undersegmented") + of(m, t + "noise") +
                  2 * of(m, t + "oversegmented") <=
              of(m, "found") - of(m, "on_objects"));
    RC_ASSERT(of(m, t + "recall") >= 0 && of(m, t + "recall") <= 1);
  }
  RC_ASSERT(of(m, "purity") > 0 && of(m, "purity") <= 1);
  RC_ASSERT(of(m, "coverage") > 0 && of(m, "coverage") <= 1);
}

}  // namespace
}  // namespace atrium::metric::primitives_properties_test
