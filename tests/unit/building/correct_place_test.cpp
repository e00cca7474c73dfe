// Corrections that say where the thing is that they name.
#include <gtest/gtest.h>

#include "houses.hpp"
#include "modules/building/correct.hpp"
#include "modules/building/place_distance.hpp"
#include "tests/support/temporary_folder.hpp"
#include "writing_host.hpp"

namespace atrium::building::correct_place_test {
namespace {

using test::BoxBuilding;
using test::House;

/// Two rooms, 4 m × 3 m and 2.88 m × 3 m, 2.5 m high, with 12 cm of wall from x = 4; faces 0 … 5 and 6 … 11 are floor,
/// ceiling, and the walls at y0, x1, y1, x0. Door 1 is in the wall between them, window 1 in the wall y = 0 of room 1.
class CorrectionPlaces : public ::testing::Test {
 protected:
  test::TemporaryFolder folder;
  std::shared_ptr<test::WritingHost> host = std::make_shared<test::WritingHost>();

  Building corrected(const std::string& lines, const Building& building = BoxBuilding::two_rooms(),
                     const Transform& transform = {}, double unit = 1) {
    const auto file = folder / "corrections.yaml";
    test::write_text(file, "atrium_corrections: 1\ncorrections:\n" + lines);
    Context context{1, host};
    Cloud cloud;
    cloud.unit = unit;
    return *Correct::run({input(building), input(transform), input(cloud)}, {{{file.string()}}}, context).building;
  }
  /// What the error says after the file's name, and its help.
  std::string refused(const std::string& lines, const Building& building = BoxBuilding::two_rooms()) {
    try {
      corrected(lines, building);
    } catch (const Error& error) {
      const std::string text = error.what(), name = (folder / "corrections.yaml").string() + ":";
      EXPECT_EQ(text.substr(0, name.size()), name);
      return text.substr(name.size()) + " | " + error.help();
    }
    return "nothing was refused";
  }
};

/// Rooms of two storeys over each other, with a window in the same place of both.
Building two_storeys() {
  House house;
  house.building.storeys = {{0, 2.5}, {3, 2.5}};
  house.room(House::rectangle(0, 0, 4, 3), 0, [](double, double) { return 2.5; });
  house.room(
      House::rectangle(0, 0, 4, 3), 3, [](double, double) { return 5.5; }, 1);
  for (const double z : {0.0, 3.0}) {
    BuildingOpening window;
    window.kind = "window";
    window.room_a = z > 0 ? 1 : 0;
    window.face_a = z > 0 ? 8 : 2;
    window.outline_a = {{1, 0, z + 1}, {1, 0, z + 2}, {2, 0, z + 2}, {2, 0, z + 1}};
    house.building.openings.push_back(window);
  }
  return house.building;
}

bool has_opening(const Building& building, const std::string& kind) {
  return std::any_of(building.openings.begin(), building.openings.end(), [&](const auto& o) { return o.kind == kind; });
}

TEST_F(CorrectionPlaces, ADoorAtItsPlaceIsTheOneThatIsMeant) {
  const Building result = corrected("  - drop_opening: {opening: door 1, near: [4.05, 1.1]}\n");
  EXPECT_FALSE(has_opening(result, "door"));
  EXPECT_TRUE(has_opening(result, "window"));
  // Some decimetres off, and with a height.
  EXPECT_FALSE(has_opening(corrected("  - drop_opening: {opening: door 1, near: [4.05, 1.6, 1.2]}\n"), "door"));
}

TEST_F(CorrectionPlaces, ADoorThatIsElsewhereIsRefusedWithWhatIsThere) {
  const Building building = BoxBuilding::two_rooms();
  const auto& window = building.openings[1].outline_a;
  const Eigen::Vector3d at = 0.5 * (window[0] + window[2]);
  const std::string place = "[" + std::to_string(at.x()) + ", " + std::to_string(at.y()) + "]";
  const std::string text = refused("  - drop_opening: {opening: door 1, near: " + place + "}\n");
  EXPECT_EQ(text.substr(0, text.find(" is 2")), "3:43: door 1") << text;
  EXPECT_NE(text.find("it is at x 4.00, y 0.95 | window 1 is there: if it is meant, give `opening: window 1`; numbers "
                      "change with the program and its parameters"),
            std::string::npos)
      << text;
  EXPECT_EQ(refused("  - change_opening: {opening: door 1, near: [4, 2.4, 1], width: 1}\n"),
            "3:45: door 1 is 1.00 m from that place: it is at x 4.00, y 0.95 | nothing else is nearer to that place; "
            "numbers change with the program and its parameters");
}

TEST_F(CorrectionPlaces, APlaceAloneMeansTheNearestOpening) {
  const Building result = corrected("  - change_opening: {near: [4.2, 1.1], width: 1 m}\n");
  EXPECT_EQ(result.openings[0].corrections, std::vector<std::string>{"changed"});
  EXPECT_TRUE(result.openings[1].corrections.empty());
  EXPECT_FALSE(has_opening(corrected("  - drop_opening: {near: [4.2, 1.1]}\n"), "door"));
  const std::string far = refused("  - drop_opening: {near: [4.1, 2.8]}\n");
  EXPECT_EQ(far.substr(0, far.find(", at x")),
            "3:26: no door or window is within 0.5 m of that place | the nearest is door 1, 1.40 m from it")
      << far;
  EXPECT_EQ(refused("  - drop_opening: {near: [4.1, 1]}\n  - drop_opening: {near: [4.1, 1]}\n"),
            "4:26: 'door 1' is no more: a correction before this one took it away | ");
}

TEST_F(CorrectionPlaces, PlacesAreThoseBeforeAllCorrections) {
  // The wall moves by 1.4 m, with its door: its place in the file stays.
  const std::string moved = "  - move_wall: {room: room 1, face: 3, near: [4, 2.7], by: -1.4, both: true}\n";
  EXPECT_FALSE(has_opening(corrected(moved + "  - drop_opening: {opening: door 1, near: [4, 1]}\n"), "door"));
  EXPECT_NO_THROW(corrected(moved + "  - move_wall: {room: room 1, face: 3, near: [4, 2.7], by: 10 cm}\n"));
  EXPECT_NO_THROW(corrected(moved + "  - rename_room: {room: room 1, near: [3.5, 2], name: A}\n" +
                            "  - set_ceiling: {room: A, near: [3.5, 2], height: 2.6}\n"));
}

TEST_F(CorrectionPlaces, OpeningsOverEachOtherNeedAHeight) {
  EXPECT_EQ(refused("  - drop_opening: {near: [1.5, 0]}\n", two_storeys()),
            "3:26: it is not clear which is meant: window 1 is 0.00 m from that place, window 2 0.00 m | name it with "
            "`opening`, or give a place nearer to it, with its height as third number");
  const Building result = corrected("  - drop_opening: {near: [1.5, 0, 4.4]}\n", two_storeys());
  ASSERT_EQ(result.openings.size(), 1U);
  EXPECT_EQ(result.openings[0].room_a, 0);
  // Beside a name two numbers are enough: the storey is that of what is named.
  EXPECT_EQ(corrected("  - drop_opening: {opening: window 2, near: [1.5, 0]}\n", two_storeys()).openings.size(), 1U);
  const std::string text = refused("  - drop_opening: {opening: window 1, near: [1.5, 0, 4.4]}\n", two_storeys());
  EXPECT_EQ(text.substr(0, 40), "3:45: window 1 is 2.40 m from that place") << text;
}

TEST_F(CorrectionPlaces, AFaceIsCheckedOnItsOwnSideOfTheWall) {
  EXPECT_NO_THROW(corrected("  - move_wall: {room: room 1, face: 3, near: [3.97, 2.5], by: 1 cm}\n"));
  EXPECT_NO_THROW(corrected("  - move_wall: {room: room 2, face: 11, near: [4.15, 2.5], by: 1 cm}\n"));
  EXPECT_EQ(refused("  - move_wall: {room: room 1, face: 3, near: [4.15, 2.5], by: 1 cm}\n"),
            "3:46: 'room 1' is 0.15 m from that place | 'room 2' is there; numbers change with the program and its "
            "parameters");
  EXPECT_EQ(refused("  - move_wall: {room: room 1, face: 3, near: [4.11, 2.5], by: 1 cm}\n"),
            "3:46: face 3 is 0.11 m from that place: its middle is at x 4.00, y 1.50 | at that place is face 11 of "
            "'room 2'; numbers change with the program and its parameters");
  EXPECT_EQ(refused("  - drop_face: {room: room 1, face: 2, near: [0.02, 1.5]}\n"),
            "3:46: face 2 is 1.50 m from that place: its middle is at x 2.00, y 0.00 | at that place is face 5 of "
            "'room 1'; numbers change with the program and its parameters");
  // A place at a wall that is in another room is none of this room.
  EXPECT_EQ(refused("  - move_wall: {room: room 1, at: [4.5, 1.5], by: 1 cm}\n"),
            "3:35: 'room 1' is 0.50 m from that place | 'room 2' is there; numbers change with the program and its "
            "parameters");
  EXPECT_EQ(refused("  - move_wall: {room: room 1, at: [4, 1], near: [4, 1], by: 1 cm}\n"),
            "3:49: 'near' and 'at' both say where the wall is | 'at' stands alone; 'near' stands beside 'wall' or "
            "'face', and checks it");
}

TEST_F(CorrectionPlaces, AWallIsCheckedByItsFace) {
  // Whatever its number is: of all walls exactly one is at that place.
  int right = 0;
  for (int wall = 1; wall <= 7; ++wall) {
    const std::string text =
        refused("  - move_wall: {room: room 1, wall: " + std::to_string(wall) + ", near: [0.03, 1.5], by: 1 cm}\n");
    if (text == "nothing was refused")
      ++right;
    else
      EXPECT_TRUE(text.find("at that place is face 5 of 'room 1'") != std::string::npos ||
                  text.find("has no face in 'room 1'") != std::string::npos)
          << text;
  }
  EXPECT_EQ(right, 1);
}

TEST_F(CorrectionPlaces, ALevelIsCheckedToo) {
  EXPECT_NO_THROW(corrected("  - set_ceiling: {room: room 2, face: 7, near: [5, 1, 2.5], height: 2.6}\n"));
  const std::string text = refused("  - set_ceiling: {room: room 2, face: 7, near: [5, 1, 0.5], height: 2.6}\n");
  EXPECT_EQ(text.substr(0, 40), "3:48: face 7 is 2.00 m from that place: ") << text;
}

TEST_F(CorrectionPlaces, RoomsAreCheckedAndFoundByTheirPlace) {
  EXPECT_EQ(corrected("  - rename_room: {room: room 2, near: [5, 1], name: Bath}\n").rooms[1].name, "Bath");
  EXPECT_EQ(corrected("  - rename_room: {near: [5, 1], name: Bath}\n").rooms[1].name, "Bath");
  EXPECT_NEAR(corrected("  - set_ceiling: {near: [5, 1], height: 2.6}\n").rooms[1].height, 2.6, 1e-9);
  EXPECT_EQ(refused("  - rename_room: {room: room 1, near: [5, 1], name: Bath}\n"),
            "3:39: 'room 1' is 1.00 m from that place | 'room 2' is there; numbers change with the program and its "
            "parameters");
  EXPECT_EQ(refused("  - set_floor: {room: room 1, near: [-3, 1], level: 0.1}\n"),
            "3:37: 'room 1' is 3.00 m from that place | nothing else is nearer to that place; numbers change with "
            "the program and its parameters");
  EXPECT_EQ(refused("  - rename_room: {near: [4.06, 1], name: Bath}\n"),
            "3:25: it is not clear which room is meant: 'room 1' and 'room 2' are at that place | give a place in the "
            "middle of the room, with a height as third number where there are storeys");
  EXPECT_EQ(refused("  - rename_room: {near: [9, 1], name: Bath}\n"),
            "3:25: no room is within 0.5 m of that place | the nearest is 'room 2', 2.00 m from it");
  EXPECT_EQ(corrected("  - rename_room: {near: [2, 1, 4], name: Above}\n", two_storeys()).rooms[1].name, "Above");
}

TEST_F(CorrectionPlaces, RoomsAreMergedAndSplitByTheirPlaces) {
  EXPECT_EQ(corrected("  - merge_rooms: {near: [[2, 1], [5, 1]], name: Hall}\n").rooms.size(), 1U);
  EXPECT_EQ(corrected("  - merge_rooms: {rooms: [room 2, room 1], near: [[5, 1], [2, 1]]}\n").rooms[0].name, "room 2");
  EXPECT_EQ(refused("  - merge_rooms: {rooms: [room 1, room 2], near: [[5, 1], [2, 1]]}\n"),
            "3:50: 'room 1' is 1.00 m from that place | 'room 2' is there; numbers change with the program and its "
            "parameters");
  EXPECT_EQ(refused("  - merge_rooms: {rooms: [room 1, room 2], near: [5, 1]}\n"),
            "3:50: 'near' has a value of the wrong kind | 2 places, one of each room: [[x, y], [x, y]]");
  EXPECT_EQ(corrected("  - split_room: {near: [5, 1.5], from: [5, 0], to: [5, 1], names: [A, B]}\n").rooms.size(), 3U);
  // After that, the parts are found by their places, and are where they say.
  EXPECT_NEAR(corrected("  - split_room: {room: room 2, from: [5, 0], to: [5, 1], names: [A, B]}\n"
                        "  - set_ceiling: {near: [4.5, 1], height: 2.7}\n")
                  .rooms.back()
                  .height,
              2.5, 0.3);
}

TEST_F(CorrectionPlaces, PlacesAreInTheScansFrameAndUnit) {
  Transform transform;
  transform.translation = {100, 0, 0};
  Building building = BoxBuilding::two_rooms();
  building.origin = {100, 0, 0};
  EXPECT_FALSE(has_opening(corrected("  - drop_opening: {near: [13.4, 3.5]}\n", building, transform, 0.3048), "door"));
}

TEST_F(CorrectionPlaces, WhatIsMeantMustBeSaid) {
  EXPECT_EQ(refused("  - drop_opening: {}\n"),
            "3:5: 'drop_opening' does not say what is meant | give one of opening, near");
  EXPECT_EQ(refused("  - change_opening: {width: 1}\n"),
            "3:5: 'change_opening' does not say what is meant | give one of opening, near");
  EXPECT_EQ(refused("  - merge_rooms: {name: A}\n"),
            "3:5: 'merge_rooms' does not say what is meant | give one of rooms, near");
  EXPECT_EQ(refused("  - rename_room: {name: A}\n"),
            "3:5: 'rename_room' does not say what is meant | give one of room, near");
  EXPECT_EQ(refused("  - drop_opening: {near: 3}\n"),
            "3:26: 'near' has a value of the wrong kind | a place of the scan, in its unit: [x, y], or [x, y, z]");
}

TEST(PlaceDistance, CountsPlanAndHeight) {
  const Building building = BoxBuilding::two_rooms();
  const auto to = [&](double x, double y, double z, bool height) {
    return distance_to(NearPlace{{x, y, z}, height}, building, building.rooms[0]);
  };
  EXPECT_EQ(to(2, 1, 9, false), 0);
  EXPECT_NEAR(to(2, 1, 9, true), 6.5, 1e-12);
  EXPECT_NEAR(to(7, 7, 0, true), 5, 1e-12);
  EXPECT_NEAR(to(7, 7, 14.5, true), 13, 1e-12);
  EXPECT_NEAR(depth_in({{3.9, 1, 1}, true}, building, building.rooms[0]), 0.1, 1e-12);
  EXPECT_EQ(depth_in({{4.05, 1, 1}, true}, building, building.rooms[0]), 0);
  EXPECT_EQ(depth_in({{3.9, 1, 3}, true}, building, building.rooms[0]), 0);
}

}  // namespace
}  // namespace atrium::building::correct_place_test
