#include "modules/metric/compactness.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>

#include "meshes.hpp"
#include "modules/synth/flat.hpp"
#include "modules/synth/room.hpp"
#include "modules/synth/round_room.hpp"

namespace atrium::metric::compactness_test {
namespace {

using V = Eigen::Vector3d;

GroundTruth truth_of_rooms(const std::vector<std::vector<V>>& outlines) {
  GroundTruth truth;
  for (const auto& outline : outlines) truth.rooms.push_back({"room", 0, outline});
  return truth;
}
const std::vector<V> square{V(0, 0, 0), V(4, 0, 0), V(4, 5, 0), V(0, 5, 0)};

Metrics compactness(const Mesh& mesh, const GroundTruth& truth) {
  Context context;
  return Compactness::run({input(mesh), OptionalInput<GroundTruth>(input(truth))}, {}, context).metrics;
}
double of(const Metrics& m, const std::string& name) { return value(m, "compactness." + name); }

TEST(MetricCompactness, AClosedRoomIsTheLeast) {
  const auto m = compactness(room(), truth_of_rooms({square}));
  EXPECT_EQ(of(m, "triangles"), 12);
  EXPECT_EQ(of(m, "polygons"), 6);
  EXPECT_EQ(of(m, "corners"), 4);
  EXPECT_EQ(of(m, "least_triangles"), 12);
  EXPECT_EQ(of(m, "ratio"), 1);
  // Corners on the sides of the outline are none.
  auto more = square;
  more.insert(more.begin() + 1, V(2, 0, 0));
  EXPECT_EQ(of(compactness(room(), truth_of_rooms({more})), "ratio"), 1);
  // A second room, L-shaped: 12 + 20 are needed.
  const std::vector<V> l{V(5, 0, 0), V(9, 0, 0), V(9, 5, 0), V(7, 5, 0), V(7, 3, 0), V(5, 3, 0)};
  EXPECT_EQ(of(compactness(room(), truth_of_rooms({square, l})), "least_triangles"), 32);
}

TEST(MetricCompactness, ObjectsDoNotCountAndPiecesDo) {
  Mesh mesh = room();
  add_rectangle(mesh, V(1, 1, 0.7), V(1, 0, 0), V(0, 1, 0), SurfaceClass::object, -1);
  EXPECT_EQ(of(compactness(mesh, truth_of_rooms({square})), "triangles"), 12);
  // The floor cut in two along x = 2, as one primitive: one polygon; as two: two.
  Mesh cut = room();
  cut.triangles.erase(cut.triangles.begin(), cut.triangles.begin() + 2);
  for (auto* column : {&cut.primitives, &cut.storeys}) column->erase(column->begin(), column->begin() + 2);
  cut.classes.erase(cut.classes.begin(), cut.classes.begin() + 2);
  add_rectangle(cut, V(0, 0, 0), V(2, 0, 0), V(0, 5, 0), SurfaceClass::floor, 0);
  add_rectangle(cut, V(2, 0, 0), V(2, 0, 0), V(0, 5, 0), SurfaceClass::floor, 0);
  EXPECT_EQ(of(compactness(cut, truth_of_rooms({square})), "polygons"), 6);
  EXPECT_EQ(of(compactness(cut, truth_of_rooms({square})), "ratio"), 14.0 / 12);
  cut.primitives.back() = cut.primitives[cut.primitives.size() - 2] = 9;
  EXPECT_EQ(of(compactness(cut, truth_of_rooms({square})), "polygons"), 7);
  // Without primitives planes alone decide.
  cut.primitives.clear();
  EXPECT_EQ(of(compactness(cut, truth_of_rooms({square})), "polygons"), 6);
  // A fold of 0.2° is two polygons.
  Mesh folded;
  add_rectangle(folded, V(0, 0, 0), V(2, 0, 0), V(0, 5, 0), SurfaceClass::floor, 0);
  add_rectangle(folded, V(2, 0, 0), V(2, 0, 2 * std::tan(0.2 * M_PI / 180)), V(0, 5, 0), SurfaceClass::floor, 0);
  EXPECT_EQ(of(compactness(folded, truth_of_rooms({square})), "polygons"), 2);
}

TEST(MetricCompactness, TruthOfScenes) {
  Context context;
  const auto truth = synth::Room::run({}, context).scene.truth;
  const auto m = compactness(truth.mesh, truth);
  EXPECT_EQ(of(m, "polygons"), static_cast<double>(truth.faces.size()));
  EXPECT_GT(of(m, "ratio"), 1);  // the window and the door
  const auto flat = synth::Flat::run({}, context).scene.truth;
  EXPECT_EQ(of(compactness(flat.mesh, flat), "polygons"), static_cast<double>(flat.faces.size()));
}

TEST(MetricCompactness, ACurvedWallCountsAsTheCoarsestChainOfItsSagitta) {
  // A circle of radius 2 m: chords of a sagitta of 5 mm span 2 · acos(1 − 0.0025) = 8.1°, so 45 would do; of the 720
  // corners every sixteenth (8°) is taken.
  std::vector<V> circle;
  for (int i = 0; i < 720; ++i) circle.emplace_back(2 * std::cos(i * M_PI / 360), 2 * std::sin(i * M_PI / 360), 0);
  const auto corners = [&](double sagitta) {
    Context context;
    const auto truth = truth_of_rooms({circle});
    return of(Compactness::run({input(room()), OptionalInput<GroundTruth>(input(truth))}, {sagitta}, context).metrics,
              "corners");
  };
  EXPECT_EQ(corners(0.005), 45);
  EXPECT_EQ(corners(0.1), 10);  // 36.4°: every 72nd
  EXPECT_EQ(corners(0), 720);
  Context context;
  const auto round = synth::RoundRoom::run({}, context).scene.truth;
  // 23 chords of at most 7.6° on the half circle, and the rectangle's three sides.
  EXPECT_NEAR(of(compactness(round.mesh, round), "corners"), 29, 1);
  EXPECT_GT(round.rooms[0].outline.size(), 70U);
}

TEST(MetricCompactness, EmptyAndBadInput) {
  Context context;
  const auto m = compactness({}, truth_of_rooms({square}));
  EXPECT_EQ(of(m, "triangles"), 0);
  EXPECT_EQ(of(m, "ratio"), 0);
  EXPECT_FALSE(has(Compactness::run({input(room()), {}}, {}, context).metrics, "compactness.ratio"));
  EXPECT_THROW(compactness(room(), {}), Error);
  Mesh bad = room();
  bad.vertices[0].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(compactness(bad, truth_of_rooms({square})), Error);
  bad = room();
  bad.primitives.pop_back();
  EXPECT_THROW(compactness(bad, truth_of_rooms({square})), Error);
  auto outline = square;
  outline[2].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(compactness(room(), truth_of_rooms({square, outline})), Error);
  EXPECT_THROW(compactness(room(), truth_of_rooms({{square[0], square[1]}})), Error);
}

}  // namespace
}  // namespace atrium::metric::compactness_test
