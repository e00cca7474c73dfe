#include "modules/synth/flat.hpp"

#include <gtest/gtest.h>

#include "scene_checks.hpp"

namespace atrium::synth::flat_test {
namespace {

SimulatedScene flat(const Flat::Params& params = {}, std::uint64_t seed = 1) {
  Context context(seed, std::make_shared<ContextHost>());
  return Flat::run(params, context).scene;
}

TEST(SynthFlat, IsExactAndClosed) {
  for (const double inner_wall : {0.05, 0.12, 0.3}) {
    Flat::Params params;
    params.inner_wall = inner_wall;
    check_scene(flat(params));
  }
}

TEST(SynthFlat, HasTheRoomsFacesAndOpeningsItSays) {
  const auto scene = flat();
  const auto& truth = scene.truth;
  EXPECT_EQ(truth.rooms.size(), 4U);
  EXPECT_EQ(truth.faces.size(), 24U);
  EXPECT_EQ(truth.openings.size(), 9U);
  // Living room: 5.712 m × 4.64 m, 2.6 m high, its floor and ceiling whole.
  EXPECT_NEAR(truth.faces[0].area(), 0.56 * 10.2 * 0.58 * 8, 1e-12);
  EXPECT_NEAR(truth.faces[1].area(), truth.faces[0].area(), 1e-12);
  // Its north wall has one door.
  EXPECT_NEAR(truth.faces[4].area(), 0.56 * 10.2 * 2.6 - 0.86 * 2.01, 1e-12);
  EXPECT_NEAR(room_volume(truth, 0), 0.56 * 10.2 * 0.58 * 8 * 2.6, 1e-9);
  EXPECT_NEAR(room_volume(truth, 1), 0.56 * 10.2 * (0.42 * 8 - 0.12) * 2.7, 1e-9);
}

TEST(SynthFlat, SidesOfAnInnerWallAreItsThicknessApart) {
  Flat::Params params;
  params.inner_wall = 0.12;
  int doors = 0;
  const auto truth = flat(params).truth;
  for (const auto& opening : truth.openings) {
    if (opening.room_b < 0) continue;
    ++doors;
    EXPECT_NEAR(opening.thickness, 0.12, 1e-12);
    const auto &a = truth.faces[opening.face_a].plane, &b = truth.faces[opening.face_b].plane;
    EXPECT_EQ(a.normal, -b.normal);
    EXPECT_NEAR(a.offset + b.offset, -0.12, 1e-12);
  }
  EXPECT_EQ(doors, 3);
}

TEST(SynthFlat, FurnitureFollowsDensityAndSeed) {
  Flat::Params empty;
  empty.furniture = 0;
  for (const auto& name : flat(empty).objects) EXPECT_TRUE(name == "reveal" || name == "door leaf") << name;
  const auto one = flat({}, 1), again = flat({}, 1), other = flat({}, 2);
  EXPECT_GT(one.objects.size(), 25U);
  EXPECT_EQ(content_hash(one), content_hash(again));
  EXPECT_NE(content_hash(one), content_hash(other));
}

TEST(SynthFlat, OpeningThatDoesNotFitIsAnError) {
  Flat::Params params;
  params.width = 7;
  params.depth = 6;
  params.inner_wall = 0.5;
  EXPECT_NO_THROW(flat(params));
  params.ceiling_height = 2.0;  // below the doors' 2.01 m: not reachable from a file
  EXPECT_THROW(flat(params), Error);
}

}  // namespace
}  // namespace atrium::synth::flat_test
