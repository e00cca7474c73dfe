#include "modules/metric/structure.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Geometry>
#include <set>

#include "meshes.hpp"
#include "modules/synth/attic.hpp"
#include "modules/synth/flat.hpp"
#include "modules/synth/room.hpp"
#include "modules/synth/two_storeys.hpp"

namespace atrium::metric::structure_test {
namespace {

using V = Eigen::Vector3d;

Metrics compare(const Mesh& mesh, const Mesh& truth, const Structure::Params& params = {}) {
  Context context;
  return Structure::run({input(mesh), {}, OptionalInput<Mesh>(input(truth))}, params, context).metrics;
}
/// The room without one of its faces.
Mesh without(int primitive) {
  Mesh all = room(), rest;
  rest.vertices = all.vertices;
  for (std::size_t i = 0; i < all.triangles.size(); ++i) {
    if (all.primitives[i] == primitive) continue;
    rest.triangles.push_back(all.triangles[i]);
    rest.classes.push_back(all.classes[i]);
  }
  return rest;
}

TEST(MetricStructure, IdenticalIsPerfect) {
  const auto m = compare(room(), room());
  for (const char* group : {"structure", "structure.wall", "structure.floor", "structure.ceiling"})
    for (const char* buffer : {".b20mm", ".b50mm", ".b100mm"}) {
      const std::string name = std::string(group) + buffer;
      EXPECT_EQ(value(m, name + ".completeness"), 1) << name;
      EXPECT_EQ(value(m, name + ".correctness"), 1) << name;
      EXPECT_NEAR(value(m, name + ".accuracy"), 0, 1e-12) << name;
    }
  EXPECT_NEAR(value(m, "structure.area.true"), 85, 1e-9);
  EXPECT_NEAR(value(m, "structure.wall.area.reconstructed"), 45, 1e-9);
}

TEST(MetricStructure, AWallMovedByThreeCentimetres) {
  // The wall x = 4 (12.5 of 45 m² of wall, 85 m² in all) stands at 4.03.
  Mesh moved = room();
  for (std::size_t v = 12; v < 16; ++v) moved.vertices[v].x() += 0.03;
  const auto m = compare(moved, room());
  EXPECT_NEAR(value(m, "structure.b20mm.completeness"), 1 - 12.5 / 85, 2e-3);
  EXPECT_NEAR(value(m, "structure.b20mm.correctness"), 1 - 12.5 / 85, 2e-3);
  EXPECT_NEAR(value(m, "structure.wall.b20mm.completeness"), 1 - 12.5 / 45, 2e-3);
  EXPECT_EQ(value(m, "structure.floor.b20mm.completeness"), 1);
  EXPECT_EQ(value(m, "structure.b50mm.completeness"), 1);
  EXPECT_EQ(value(m, "structure.wall.b50mm.correctness"), 1);
  EXPECT_NEAR(value(m, "structure.wall.b50mm.accuracy"), 0, 1e-12);  // most wall stands right
  // All four walls moved outwards by 3 cm: the median moves with them.
  Mesh all = room();
  for (std::size_t v = 8; v < 24; ++v) {
    const std::size_t wall = (v - 8) / 4;
    all.vertices[v] += 0.03 * std::array{V(0, -1, 0), V(1, 0, 0), V(0, 1, 0), V(-1, 0, 0)}[wall];
  }
  EXPECT_NEAR(value(compare(all, room()), "structure.wall.b50mm.accuracy"), 0.03, 1e-9);
}

TEST(MetricStructure, AMissingFaceLacksInCompletenessOnly) {
  const auto m = compare(without(1), room());
  // At the rims of the missing ceiling nothing else matches: walls stand across it.
  EXPECT_NEAR(value(m, "structure.b50mm.completeness"), 1 - 20.0 / 85, 1e-9);
  EXPECT_EQ(value(m, "structure.b50mm.correctness"), 1);
  EXPECT_EQ(value(m, "structure.ceiling.b50mm.completeness"), 0);
  EXPECT_FALSE(has(m, "structure.ceiling.b50mm.correctness"));
  EXPECT_FALSE(has(m, "structure.ceiling.b50mm.accuracy"));
  EXPECT_EQ(value(m, "structure.wall.b50mm.completeness"), 1);
}

TEST(MetricStructure, AFalseFaceLacksInCorrectnessOnly) {
  Mesh more = room();
  add_rectangle(more, V(2, 1, 0), V(0, 0, 2.5), V(0, 2, 0), SurfaceClass::wall, 6);
  const auto m = compare(more, room());
  EXPECT_EQ(value(m, "structure.b50mm.completeness"), 1);
  EXPECT_NEAR(value(m, "structure.b50mm.correctness"), 85.0 / 90, 1e-9);
  EXPECT_NEAR(value(m, "structure.wall.b50mm.correctness"), 45.0 / 50, 1e-9);
  // A doubled face is right twice; as an object it counts nowhere.
  Mesh doubled = room();
  add_rectangle(doubled, V(0, 0, 0), V(4, 0, 0), V(0, 5, 0), SurfaceClass::floor, 0);
  EXPECT_EQ(value(compare(doubled, room()), "structure.b20mm.correctness"), 1);
  for (auto& c : more.classes) c = SurfaceClass::object;
  EXPECT_EQ(value(compare(more, room()), "structure.area.reconstructed"), 0);
}

TEST(MetricStructure, ClassesAndDirectionsThatDiffer) {
  // A ceiling taken for a wall is complete in all, missing as a ceiling, wrong as a wall.
  Mesh confused = room();
  confused.classes[2] = confused.classes[3] = SurfaceClass::wall;
  const auto m = compare(confused, room());
  EXPECT_EQ(value(m, "structure.b20mm.completeness"), 1);
  EXPECT_EQ(value(m, "structure.ceiling.b20mm.completeness"), 0);
  EXPECT_NEAR(value(m, "structure.wall.b20mm.correctness"), 45.0 / 65, 1e-9);
  // Inside out: right unless the sides count.
  Mesh turned = room();
  for (auto& t : turned.triangles) std::swap(t[0], t[1]);
  EXPECT_EQ(value(compare(turned, room()), "structure.b20mm.completeness"), 1);
  Structure::Params oriented;
  oriented.oriented = true;
  EXPECT_EQ(value(compare(turned, room(), oriented), "structure.b20mm.completeness"), 0);
  EXPECT_EQ(value(compare(room(), room(), oriented), "structure.b20mm.completeness"), 1);
  // Without classes there are totals only.
  Mesh plain = room();
  plain.classes.clear();
  EXPECT_EQ(value(compare(plain, room()), "structure.b20mm.completeness"), 1);
  EXPECT_FALSE(has(compare(plain, room()), "structure.wall.b20mm.completeness"));
}

TEST(MetricStructure, NormalsCount) {
  // A floor tilted by 5° about its middle line: matches within 10 cm near that line; with max_angle 3° nowhere.
  Mesh floor, tilted;
  add_rectangle(floor, V(-2, -2, 0), V(4, 0, 0), V(0, 4, 0), SurfaceClass::floor, 0);
  const double slope = std::tan(5 * M_PI / 180);
  add_rectangle(tilted, V(-2, -2, -2 * slope), V(4, 0, 4 * slope), V(0, 4, 0), SurfaceClass::floor, 0);
  const double reach = 0.1 / std::sin(5 * M_PI / 180);  // along the true floor
  EXPECT_NEAR(value(compare(tilted, floor), "structure.b100mm.completeness"), reach / 2, 0.01);
  Structure::Params strict;
  strict.max_angle = 3;
  EXPECT_EQ(value(compare(tilted, floor, strict), "structure.b100mm.completeness"), 0);
}

TEST(MetricStructure, TheCurveRisesWhereAWallStandsOff) {
  // The wall x = 4 stands 3 cm off: it is missing in the first two steps of the curve and there in all others.
  Mesh moved = room();
  for (std::size_t v = 12; v < 16; ++v) moved.vertices[v].x() += 0.03;
  Context context;
  const auto curve = Structure::run({input(moved), {}, OptionalInput<Mesh>(input(room()))}, {}, context).curve;
  for (int step = 1; step <= 15; ++step) {
    const std::string buffer = (step < 10 ? ".b0" : ".b") + std::to_string(10 * step) + "mm";
    for (const char* key : {".completeness", ".correctness"}) {
      EXPECT_NEAR(value(curve, "structure_curve.wall" + buffer + key), step < 3 ? 1 - 12.5 / 45 : 1, 2e-3) << step;
      EXPECT_EQ(value(curve, "structure_curve.floor" + buffer + key), 1);
    }
    EXPECT_TRUE(has(curve, "structure_curve.total" + buffer + ".accuracy"));
  }
  EXPECT_FALSE(has(curve, "structure_curve.total.b160mm.completeness"));
  Structure::Params none;
  none.curve_reach = 0;
  EXPECT_TRUE(
      Structure::run({input(moved), {}, OptionalInput<Mesh>(input(room()))}, none, context).curve.values.empty());
}

TEST(MetricStructure, AMissingDoorLeaf) {
  // A leaf of 0.9 × 2 m closes the doorway in the truth and is open in the model: 1.8 m² of wall lack, less the rim
  // within the buffer of the wall around it; and the other way round.
  const auto wall = [](bool leaf) {
    Mesh mesh;
    add_rectangle(mesh, V(0, 0, 0), V(0, 0, 2.5), V(1, 0, 0), SurfaceClass::wall, 0);
    add_rectangle(mesh, V(1, 0, 2), V(0, 0, 0.5), V(0.9, 0, 0), SurfaceClass::wall, 0);
    add_rectangle(mesh, V(1.9, 0, 0), V(0, 0, 2.5), V(1.1, 0, 0), SurfaceClass::wall, 0);
    if (leaf) add_rectangle(mesh, V(1, 0, 0), V(0, 0, 2), V(0.9, 0, 0), SurfaceClass::wall, 0);
    return mesh;
  };
  Structure::Params fine;
  fine.spacing = 0.01;
  for (const double b : {0.02, 0.05, 0.1}) {
    // Quarter circles at the upper corners of the rim, where two walls are near.
    const double core = (0.9 - 2 * b) * (2 - b);
    const auto m = compare(wall(false), wall(true), fine), back = compare(wall(true), wall(false), fine);
    const std::string name = "structure.wall.b" + std::to_string(std::lround(1000 * b)) + "mm";
    EXPECT_NEAR(value(m, name + ".completeness"), 1 - core / 7.5, 2e-3) << b;
    EXPECT_EQ(value(m, name + ".correctness"), 1);
    EXPECT_NEAR(value(back, name + ".correctness"), 1 - core / 7.5, 2e-3);
    EXPECT_EQ(value(back, name + ".completeness"), 1);
  }
}

TEST(MetricStructure, TruthOfEverySceneAgreesWithItself) {
  Context context;
  for (const auto& scene : {synth::Room::run({}, context).scene, synth::TwoStoreys::run({}, context).scene,
                            synth::Attic::run({}, context).scene}) {
    const auto m =
        Structure::run({input(scene.truth.mesh), OptionalInput<GroundTruth>(input(scene.truth)), {}}, {}, context);
    for (const auto* list : {&m.metrics, &m.curve})
      for (const auto& metric : list->values) EXPECT_TRUE(!metric.unit.empty() || metric.value == 1) << metric.name;
  }
}

TEST(MetricStructure, RigidMotionsOfBothSidesChangeNothing) {
  Mesh moved = room();
  for (std::size_t v = 12; v < 16; ++v) moved.vertices[v].x() += 0.03;
  const auto before = compare(moved, room());
  Transform motion;
  motion.rotation = Eigen::AngleAxisd(1.1, V(1, -2, 0.5).normalized()).toRotationMatrix();
  motion.translation = {500000, 5400000, 300};
  const auto after = compare(transformed(moved, motion), transformed(room(), motion));
  ASSERT_EQ(before.values.size(), after.values.size());
  for (std::size_t i = 0; i < before.values.size(); ++i)
    EXPECT_NEAR(before.values[i].value, after.values[i].value, 2e-3) << before.values[i].name;
}

TEST(MetricStructure, TruthOfASceneAgreesWithItself) {
  Context context;
  const auto scene = synth::Flat::run({}, context).scene;
  Mesh mesh = scene.truth.mesh;
  auto truth = scene.truth;
  truth.origin = truth.mesh.origin = {500000, 5400000, 100};
  mesh.origin = {500000, 5400000, 100};
  const auto m = Structure::run({input(mesh), OptionalInput<GroundTruth>(input(truth)), {}}, {}, context).metrics;
  EXPECT_EQ(value(m, "structure.b20mm.completeness"), 1);
  EXPECT_EQ(value(m, "structure.b20mm.correctness"), 1);
  double area = 0;
  for (const auto& face : truth.faces) area += face.area();
  EXPECT_NEAR(value(m, "structure.area.true"), area, 1e-6);
}

TEST(MetricStructure, SameBytesWithAnyNumberOfThreads) {
  std::set<std::string> hashes;
  for (const std::size_t threads : {1, 2, 4}) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    hashes.insert(content_hash(compare(without(3), room())));
  }
  EXPECT_EQ(hashes.size(), 1U);
}

TEST(MetricStructure, BadInput) {
  Context context;
  EXPECT_THROW(Structure::run({input(room()), {}, {}}, {}, context), Error);
  EXPECT_THROW(Structure::run({input(room()), OptionalInput<GroundTruth>(input(GroundTruth{})),
                               OptionalInput<Mesh>(input(room()))},
                              {}, context),
               Error);
  EXPECT_THROW(compare(room(), {}), Error);
  Structure::Params params;
  params.buffers = {0.0205};
  EXPECT_THROW(compare(room(), room(), params), Error);
  // A reconstruction of nothing is a result: nothing is complete.
  const auto m = compare({}, room());
  EXPECT_EQ(value(m, "structure.b50mm.completeness"), 0);
  EXPECT_FALSE(has(m, "structure.b50mm.correctness"));
  Mesh broken = room();
  broken.triangles[0][0] = 99;
  EXPECT_THROW(compare(broken, room()), Error);
  broken = room();
  broken.vertices[5].y() = std::nan("");
  EXPECT_THROW(compare(broken, room()), Error);
  EXPECT_THROW(compare(room(), broken), Error);
  broken = room();
  broken.classes.pop_back();
  EXPECT_THROW(compare(broken, room()), Error);
  EXPECT_THROW(compare(room(), broken), Error);
  // Objects alone are no truth; flat and doubled points have no area.
  Mesh objects = room();
  objects.classes.assign(objects.classes.size(), SurfaceClass::object);
  EXPECT_THROW(compare(room(), objects), Error);
  Mesh spots = room();
  for (auto& v : spots.vertices) v = V(1, 1, 1);
  EXPECT_THROW(compare(room(), spots), Error);
  EXPECT_EQ(value(compare(spots, room()), "structure.b50mm.completeness"), 0);
}

}  // namespace
}  // namespace atrium::metric::structure_test
