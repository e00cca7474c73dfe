// Rooms that no cut into storeys tells: split levels, halls, galleries, leaning walls; and which proposal is taken.
#include "modules/layout/prisms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "modules/layout/surest.hpp"
#include "tests/support/rooms.hpp"
#include "tests/unit/layout/chain.hpp"

namespace atrium::layout::prisms_test {
namespace {

using namespace atrium::test;
using Scene = atrium::test::Rooms;

struct Proposal {
  Input<CellComplex> cells;
  Input<Structure> structure;
  std::shared_ptr<Warnings> warnings = std::make_shared<Warnings>();
};

Proposal prisms_of(const PlanePrimitives& planes) {
  Proposal result;
  Context context(1, result.warnings);
  auto out = Prisms::run({input(planes)}, {}, context);
  result.cells = input(std::move(out.cells));
  result.structure = input(std::move(out.structure));
  return result;
}

/// The building of a proposal, its rooms by falling area.
Layout built(const Proposal& proposal) {
  Layout layout;
  layout.warnings = proposal.warnings;
  Context context(1, layout.warnings);
  layout.cells = *proposal.cells;
  layout.structure = *proposal.structure;
  layout.building = Faces::run({proposal.cells, proposal.structure}, context).building;
  layout.meshes = Mesh::run({input(layout.building), {}}, {});
  return layout;
}

void add_room(Scene& scene, double x0, double y0, double x1, double y1, double z0, double z1) {
  scene.floor(x0, y0, x1, y1, z0).ceiling(x0, y0, x1, y1, z1);
  scene.walls({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, 0, z0, z1);
}

void expect_rooms(const Layout& layout, const std::vector<std::pair<double, double>>& area_and_height) {
  ASSERT_EQ(layout.building.rooms.size(), area_and_height.size());
  for (std::size_t r = 0; r < area_and_height.size(); ++r) {
    EXPECT_NEAR(layout.building.rooms[r].area, area_and_height[r].first, 1e-3 * area_and_height[r].first);
    EXPECT_NEAR(layout.building.rooms[r].height, area_and_height[r].second, 2e-3);
  }
  EXPECT_EQ(flaw(layout), "");
}

TEST(Prisms, ARoomIsTheSameAsFromStoreys) {
  const auto layout = built(prisms_of(l_room().planes()));
  expect_rooms(layout, {{21, 2.5}});
  EXPECT_EQ(layout.building.faces.size(), 8U);
}

TEST(Prisms, SplitLevelsAreRoomsOfTheirOwn) {
  Scene scene;
  add_room(scene, 0, 0, 5, 4, 0, 2.5);
  add_room(scene, 0, 0, 5, 4.5, 2.8, 5.3);
  add_room(scene, 5.12, 0, 9, 4, 1.4, 3.9);
  const auto layout = built(prisms_of(scene.planes()));
  expect_rooms(layout, {{22.5, 2.5}, {20, 2.5}, {15.52, 2.5}});
  ASSERT_EQ(layout.building.storeys.size(), 3U);
  EXPECT_NEAR(layout.building.storeys[1].elevation, 1.4, 1e-6);
}

TEST(Prisms, AHallBesideTwoStoreysIsOneRoom) {
  Scene scene;
  add_room(scene, 0, 0, 5, 4, 0, 2.5);
  add_room(scene, 0, 0, 5, 4, 2.8, 5.3);
  add_room(scene, 5.12, 0, 10, 5, 0, 5.3);
  const auto layout = built(prisms_of(scene.planes()));
  expect_rooms(layout, {{24.4, 5.3}, {20, 2.5}, {20, 2.5}});
  EXPECT_EQ(layout.building.storeys.size(), 2U);
}

TEST(Prisms, LevelsThatAreOneStandApart) {
  Scene scene;
  add_room(scene, 0, 0, 5, 4, 0, 2.5);
  add_room(scene, 12, 0, 16, 4, 0.03, 2.53);  // its floor and ceiling are taken for those of the other room
  const auto layout = built(prisms_of(scene.planes()));
  ASSERT_EQ(layout.building.rooms.size(), 2U);
  EXPECT_NEAR(layout.building.rooms[1].area, 16, 0.02);
}

TEST(Prisms, AStoreysElevationIsThatOfItsLargestRoom) {
  Scene scene;
  add_room(scene, 0, 0, 5, 4, 0, 2.5);
  add_room(scene, 5.12, 0, 9, 4, 0.6, 3.1);
  const auto layout = built(prisms_of(scene.planes()));
  ASSERT_EQ(layout.building.storeys.size(), 1U);
  EXPECT_NEAR(layout.building.storeys[0].elevation, 0, 1e-6);
}

/// Two rooms of 4 m whose common wall ends before the wall y = 4, at the line of low fronts; the ceiling goes on over
/// the gap.
std::size_t rooms_with_gap(double gap, bool floor_in_it) {
  Scene scene;
  scene.walls({{0, 0}, {8, 0}, {8, 4}, {0, 4}}).ceiling(0, 0, 8, 4);
  scene.wall(3.94, 0, 3.94, 4 - gap).wall(4.06, 4 - gap, 4.06, 0);
  scene.wall(3.9, 4 - gap, 0.1, 4 - gap, 0, 1.2).wall(7.9, 4 - gap, 4.1, 4 - gap, 0, 1.2);
  scene.floor(0, 0, 8, 4, 0, [&](const Eigen::Vector3d& p) { return p.y() < 4 - gap || floor_in_it; });
  return built(prisms_of(scene.planes())).building.rooms.size();
}

TEST(Prisms, NobodyGoesThroughTheGapBehindACupboard) {
  EXPECT_EQ(rooms_with_gap(0.3, false), 2U);
  EXPECT_EQ(rooms_with_gap(0.65, false), 2U) << "a wardrobe";
  EXPECT_EQ(rooms_with_gap(0.65, true), 1U) << "a passage: its floor was seen";
  EXPECT_EQ(rooms_with_gap(0.3, true), 2U) << "a column's width from the wall";
  EXPECT_EQ(rooms_with_gap(1, false), 1U);
}

TEST(Prisms, SlabsWithoutThicknessPartStoreys) {
  Scene scene;
  add_room(scene, 0, 0, 5, 4, 0, 2.5);
  add_room(scene, 0, 0, 5, 4, 2.5, 5);
  expect_rooms(built(prisms_of(scene.planes())), {{20, 2.5}, {20, 2.5}});
}

TEST(Prisms, TheHoleOfAStairPartsStoreys) {
  // 8 x 5 m; the slab between 2.5 and 2.8 has a hole of 1 x 3 m at the wall x = 8.
  const auto slab = [](const Eigen::Vector3d& p) { return p.x() < 7 || p.y() < 1 || p.y() > 4; };
  Scene scene;
  scene.floor(0, 0, 8, 5).ceiling(0, 0, 8, 5, 2.5, slab).floor(0, 0, 8, 5, 2.8, slab).ceiling(0, 0, 8, 5, 5.3);
  scene.walls({{0, 0}, {8, 0}, {8, 5}, {0, 5}}, 0, 0, 5.3);
  // The edge of the slab, seen from the hole.
  scene.wall(7, 4, 7, 1, 2.5, 2.8).wall(7, 1, 8, 1, 2.5, 2.8).wall(8, 4, 7, 4, 2.5, 2.8);
  const auto layout = built(prisms_of(scene.planes()));
  expect_rooms(layout, {{40, 2.5}, {40, 2.5}});
}

/// Rooms whose wall at the far end leans out by `lean` metres, one over the other, `width` metres wide at the floor.
struct Leaning {
  double width, lean;
  int storeys;
};
class LeaningWall : public testing::TestWithParam<Leaning> {};

TEST_P(LeaningWall, BoundsTheRoom) {
  const auto [width, lean, storeys] = GetParam();
  Scene scene;
  for (int s = 0; s < storeys; ++s) {
    const double z = 2.8 * s;
    scene.floor(0, 0, width, 4, z).ceiling(0, 0, width + lean, 4, z + 2.5);
    scene.wall(0, 4, 0, 0, z, z + 2.5);
    const auto below = [w = width, l = lean, z](const Eigen::Vector3d& p) {
      return p.x() <= w + l * (p.z() - z) / 2.5;
    };
    scene.add({0, 0, z}, {width + lean, 0, 0}, {0, 0, 2.5}, {0, 1, 0}, below);
    scene.add({0, 4, z}, {width + lean, 0, 0}, {0, 0, 2.5}, {0, -1, 0}, below);
    scene.add({width, 0, z}, {0, 4, 0}, {lean, 0, 2.5}, {-2.5, 0, lean});
  }
  const auto layout = built(prisms_of(scene.planes()));
  ASSERT_EQ(layout.building.rooms.size(), static_cast<std::size_t>(storeys));
  for (const auto& room : layout.building.rooms) EXPECT_NEAR(room.volume, 4 * 2.5 * (width + lean / 2), 0.02);
  EXPECT_EQ(layout.building.faces.size(), 6U * static_cast<std::size_t>(storeys));
  EXPECT_EQ(std::count_if(layout.building.faces.begin(), layout.building.faces.end(),
                          [](const BuildingFace& face) { return face.surface == SurfaceClass::wall; }),
            4 * storeys);
  EXPECT_EQ(flaw(layout), "");
}
INSTANTIATE_TEST_SUITE_P(Outwards, LeaningWall,
                         testing::Values(Leaning{5, 0.2, 1}, Leaning{5, 0.67, 1}, Leaning{5, 1.2, 1},
                                         Leaning{3, 1.2, 1}, Leaning{5, 0.5, 2}));

TEST(Prisms, FurnitureAndSmallSlopesAreNoLevels) {
  Scene scene;
  add_room(scene, 0, 0, 6, 5, 0, 2.6);
  scene.floor(1, 1, 3, 3, 0.75).ceiling(1, 1, 3, 3, 0.7);        // a table
  scene.add({0, 0, 2.2}, {6, 0, 0}, {0, 0.3, 0.4}, {0, 4, -3});  // a cornice
  const auto layout = built(prisms_of(scene.planes()));
  expect_rooms(layout, {{30, 2.6}});
  EXPECT_EQ(layout.building.faces.size(), 6U);
}

TEST(Prisms, WithoutCeilingsThereIsNoRoom) {
  Scene scene;
  scene.floor(0, 0, 4, 3).walls({{0, 0}, {4, 0}, {4, 3}, {0, 3}});
  const Proposal proposal = prisms_of(scene.planes());
  for (const auto& storey : proposal.cells->storeys)
    EXPECT_TRUE(
        std::none_of(storey.cells.begin(), storey.cells.end(), [](const LayoutCell& cell) { return cell.room >= 0; }));
}

TEST(Prisms, OnlyWallsAreAnError) {
  Scene scene;
  scene.walls({{0, 0}, {4, 0}, {4, 3}, {0, 3}});
  try {
    prisms_of(scene.planes());
    FAIL() << "no error";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("no plane is level"), std::string::npos);
  }
}

class SurestOf : public testing::Test {
 protected:
  static Proposal storeys_of(const std::shared_ptr<const PlanePrimitives>& planes) {
    Proposal result;
    Context context(1, result.warnings);
    result.structure = input(Storeys::run({planes}, {}, context).structure);
    const auto cells = input(Partition::run({result.structure}, {}, context).cells);
    const auto rooms = input(atrium::layout::Rooms::run({cells}, {}, context).cells);
    result.cells = input(Heights::run({rooms}, {}, context).cells);
    return result;
  }
  static Surest::Out surest(const Proposal& a, const Proposal& b) {
    Context context;
    return Surest::run({a.cells, a.structure, b.cells, b.structure}, {}, context);
  }
};

TEST_F(SurestOf, TheFirstIsTakenWhereBothAreAsSure) {
  const auto planes = input(l_room().planes());
  const Proposal a = storeys_of(planes), b = prisms_of(*planes);
  EXPECT_EQ(surest(a, b).cells, a.cells);
  EXPECT_EQ(surest(b, a).cells, b.cells);
  ASSERT_EQ(surest(a, b).rest.rooms.size(), 1U) << "the other one's rooms";
  EXPECT_NEAR(surest(a, b).rest.rooms[0].area, 21, 0.1);
}

TEST_F(SurestOf, TheSurerIsTakenFromEitherPlace) {
  Scene scene;  // split levels, of which storeys lose one
  add_room(scene, 0, 0, 5, 4, 0, 2.5);
  add_room(scene, 0, 0, 5, 4, 2.8, 5.3);
  add_room(scene, 5.12, 0, 10, 4, 1.4, 3.9);
  const auto planes = input(scene.planes());
  const Proposal a = storeys_of(planes), b = prisms_of(*planes);
  EXPECT_EQ(surest(a, b).cells, b.cells);
  EXPECT_EQ(surest(b, a).structure, b.structure);
  EXPECT_TRUE(surest(a, b).rest.rooms.empty()) << "what the scan confirms far less is no second opinion";
}

TEST_F(SurestOf, AProposalWithoutRoomsIsNotTaken) {
  Scene scene;
  scene.floor(0, 0, 4, 3).walls({{0, 0}, {4, 0}, {4, 3}, {0, 3}});
  const auto planes = input(scene.planes());
  const Proposal a = storeys_of(planes), b = prisms_of(*planes);
  EXPECT_EQ(surest(a, b).cells, a.cells);
  EXPECT_EQ(surest(b, a).cells, a.cells);
}

TEST_F(SurestOf, ProposalsOfDifferentPlanesAreAnError) {
  const Proposal a = prisms_of(l_room().planes()), b = prisms_of(box_room().planes());
  EXPECT_THROW(surest(a, b), Error);
}

}  // namespace
}  // namespace atrium::layout::prisms_test
