// Planes of a furnished flat of 2 x 2 rooms: 8 mm noise, 1 % outliers, inner walls of 12 cm seen from both sides; the
// share of structural faces that one primitive matches with an IoU above 0.8 is the counter `found`.
#include <benchmark/benchmark.h>

#include <map>

#include "modules/plane/ransac.hpp"
#include "modules/plane/region_growing.hpp"
#include "tests/support/flat_cloud.hpp"

namespace {

using namespace atrium;

std::vector<test::Face> turned_flat() {
  const Eigen::Quaterniond turn =
      Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(0.04, Eigen::Vector3d::UnitX());
  std::vector<test::Face> faces = test::furnished_flat();
  for (test::Face& face : faces) {
    face.corner = turn * face.corner;
    face.u = turn * face.u;
    face.v = turn * face.v;
  }
  return faces;
}

const Input<Cloud>& flat_cloud(std::size_t points, bool normals) {
  static std::map<std::pair<std::size_t, bool>, Input<Cloud>> clouds;
  Input<Cloud>& cloud = clouds[{points, normals}];
  if (!cloud) cloud = input(test::sample(turned_flat(), {.points = points, .normals = normals}));
  return cloud;
}

template <class Node>
void find_planes(benchmark::State& state, bool normals) {
  const Input<Cloud>& cloud = flat_cloud(static_cast<std::size_t>(state.range(0)), normals);
  Context context;
  PlanePrimitives planes;
  for (auto _ : state) planes = Node::run({cloud}, {}, context).planes;
  state.SetItemsProcessed(state.iterations() * state.range(0));
  const std::vector<test::Face> faces = turned_flat();
  double structural = 0;
  double found = 0;
  for (const test::FaceMatch& match : test::match_faces(faces, planes)) {
    if (!faces[match.face].structural || faces[match.face].area() < 0.5) continue;
    ++structural;
    if (match.best_iou > 0.8) ++found;
  }
  state.counters["found"] = found / structural;
  state.counters["planes"] = static_cast<double>(planes.primitives.size());
}

void BM_Ransac(benchmark::State& state) { find_planes<plane::Ransac>(state, true); }
void BM_RegionGrowing(benchmark::State& state) { find_planes<plane::RegionGrowing>(state, false); }
BENCHMARK(BM_Ransac)
    ->Arg(100000)
    ->Arg(1000000)
    ->Arg(4000000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();
BENCHMARK(BM_RegionGrowing)
    ->Arg(100000)
    ->Arg(1000000)
    ->Arg(4000000)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

}  // namespace
