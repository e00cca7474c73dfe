#include <gtest/gtest.h>

#include <algorithm>

#include "modules/normal/estimate.hpp"
#include "modules/normal/orient.hpp"
#include "modules/plane/ransac.hpp"
#include "modules/plane/region_growing.hpp"
#include "modules/synth/flat.hpp"
#include "modules/synth/scan.hpp"

namespace atrium::plane::simulated_flat_test {
namespace {

synth::Scan::Out simulated_scan(Context& context) {
  synth::Scan::Params params;
  params.points = 300000;
  params.pattern = synth::Scan::Pattern::uniform_area;
  params.positions = 6;
  params.sensors = true;
  params.outside = false;
  params.windows = synth::Scan::Windows::open;
  params.mixed_pixels = 0;
  params.angular_noise = 0;
  params.yaw = 23;
  params.tilt = 2.5;
  return synth::Scan::run({input(synth::Flat::run({}, context).scene)}, params, context);
}

/// Every wall and ceiling is one primitive, turned to its room. The floors are one surface through the doorways.
void expect_structure(const GroundTruth& truth, const PlanePrimitives& planes) {
  std::vector<double> points(truth.faces.size(), 0);
  for (const std::int32_t label : planes.cloud->labels)
    if (label >= 0) ++points[static_cast<std::size_t>(label)];
  std::vector<double> best(truth.faces.size(), 0);
  std::vector<double> cosine(truth.faces.size(), 0);
  std::vector<double> covered(truth.faces.size(), 0);
  for (const PlanePrimitive& p : planes.primitives) {
    std::vector<double> shared(truth.faces.size(), 0);
    for (const std::uint32_t i : p.inliers)
      if (planes.cloud->labels[i] >= 0) ++shared[static_cast<std::size_t>(planes.cloud->labels[i])];
    for (std::size_t f = 0; f < shared.size(); ++f) {
      covered[f] = std::max(covered[f], shared[f] / points[f]);
      const double iou = shared[f] / (points[f] + static_cast<double>(p.inliers.size()) - shared[f]);
      if (iou <= best[f]) continue;
      best[f] = iou;
      cosine[f] = p.plane.normal.dot(truth.faces[f].plane.normal);
    }
  }
  for (std::size_t f = 0; f < best.size(); ++f) {
    const bool floor = truth.faces[f].surface == SurfaceClass::floor;
    if (points[f] < 300) continue;
    EXPECT_GT(floor ? covered[f] : best[f], 0.8) << "face " << f << ", " << name_of(truth.faces[f].surface);
    EXPECT_GT(cosine[f], 0.9999) << "face " << f;
  }
}

TEST(PlanesOfASimulatedFlat, RansacFindsEveryStructuralFace) {
  Context context;
  auto scan = simulated_scan(context);
  const auto normals = input(normal::Estimate::run({input(std::move(scan.cloud))}, {}, context).cloud);
  const auto oriented = input(normal::Orient::run({normals}, {}, context).cloud);
  expect_structure(scan.truth, Ransac::run({oriented}, {}, context).planes);
}

TEST(PlanesOfASimulatedFlat, RegionGrowingFindsEveryStructuralFace) {
  Context context;
  auto scan = simulated_scan(context);
  scan.cloud.sensors.clear();
  scan.cloud.source.clear();
  expect_structure(scan.truth, RegionGrowing::run({input(std::move(scan.cloud))}, {}, context).planes);
}

}  // namespace
}  // namespace atrium::plane::simulated_flat_test
