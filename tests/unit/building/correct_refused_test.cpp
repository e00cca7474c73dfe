// Files of corrections that cannot be read or carried out, and what is said of them.
#include <nlohmann/json.hpp>
#include <set>

#include "corrections.hpp"
#include "modules/building/corrections_file.hpp"

namespace atrium::building::correct_refused_test {
namespace {

using test::BoxBuilding;
using test::Corrections;

TEST_F(Corrections, TheFileIsReadWithPlaces) {
  EXPECT_EQ(refused("  - rename_rom: {room: room 1, name: A}\n"),
            "3:5: unknown correction 'rename_rom' | did you mean 'rename_room'?");
  EXPECT_EQ(refused("  - rename_room: {room: room 1, nam: A}\n"),
            "3:33: unknown key 'nam' of 'rename_room' | did you mean 'name'?");
  EXPECT_EQ(refused("  - rename_room: {room: room 1}\n"),
            "3:5: 'name' of 'rename_room' is missing | share/doc/corrections.md shows the format");
  EXPECT_EQ(refused("  - rename_room: {room: rom 1, name: A}\n"),
            "3:25: there is no room 'rom 1' | did you mean 'room 1'?");
  EXPECT_EQ(refused("  - rename_room: {room: room 1, name: room 2}\n"),
            "3:39: there is a room 'room 2' already | rooms have different names");
  EXPECT_PRED2(begins_with, refused("  - move_wall: {room: room 1, face: 3, by: far}\n"),
               "3:44: 'far' is not a number, and 'by' is a length | e.g. 2 cm (len");
  EXPECT_EQ(refused("  - move_wall: {room: room 1, face: 3, at: [1, 2], by: 1 m}\n"),
            "3:5: 'move_wall' needs exactly one of wall, face, at | 2 of them are given");
  EXPECT_PRED2(begins_with, refused("  - move_wall: {room: room 1, at: [1, far], by: 1 m}\n"),
               "3:39: 'far' is not a number, and 'a");
  EXPECT_EQ(refused("  - set_thickness: {room: room 1, thickness: 30 cm}\n"),
            "3:5: 'set_thickness' needs exactly one of wall, face, at | 0 of them are given");
  EXPECT_EQ(refused("  - change_opening: {opening: door 1}\n"),
            "3:5: 'change_opening' changes nothing | give one of kind, distance, by, width, height, sill");
  EXPECT_EQ(refused("  - drop_opening: door 1\n"),
            "3:19: 'drop_opening' needs its keys | as in `- drop_opening: {opening: …}`");
  EXPECT_PRED2(begins_with, refused("  - rename_room: {room: [a, name: A}\n"), "3:");
  EXPECT_EQ(refused("  - rename_room: {room: room 1, name: A}\n  - drop_opening: {opening: window 7}\n"),
            "4:29: there is no 'window 7' | did you mean 'window 1'?");
}

TEST_F(Corrections, WallsThatAreNotThereAreNamed) {
  EXPECT_EQ(refused("  - move_wall: {room: room 1, face: 30, by: 1}\n"),
            "3:37: there is no face 30 | building.json counts 12 faces from 0");
  EXPECT_EQ(refused("  - move_wall: {room: room 1, face: 9, by: 1}\n"),
            "3:37: face 9 is none of 'room 1' | numbers are those of building.json before all corrections; its walls: "
            "face 2, face 3, face 4, face 5");
  EXPECT_PRED2(begins_with, refused("  - move_wall: {room: room 1, face: 0, by: 1}\n"),
               "3:37: face 0 is a floor, not a wal");
  EXPECT_PRED2(begins_with, refused("  - move_wall: {room: room 1, wall: wall 99, by: 1}\n"),
               "3:37: there is no 'wall 99' | w");
  EXPECT_EQ(refused("  - move_wall: {room: room 1, at: [0, 0], by: 1}\n"),
            "3:35: that place is in the corner of face 2 and face 5 | give one at the middle of the wall");
  EXPECT_PRED2(begins_with, refused("  - move_wall: {room: room 1, at: [2, 9], by: 1}\n"),
               "3:35: no wall of 'room 1' is within 1 m of that pla");
  EXPECT_EQ(refused("  - merge_rooms: {rooms: [room 1, room 2]}\n  - move_wall: {room: room 1, face: 3, by: 1}\n"),
            "4:37: face 3 is no more: a correction before this one took it away | ");
}

TEST_F(Corrections, WhatDoesNotFitIsRefused) {
  EXPECT_EQ(
      refused("  - move_wall: {room: room 1, face: 3, by: 0.2}\n"),
      "3:5: 'room 1' would reach 0.24 m2 into 'room 2' | a smaller `by`; or `both: true`, which moves the whole wall");
  EXPECT_PRED2(begins_with, refused("  - move_wall: {room: room 1, face: 3, by: -4.5}\n"),
               "3:44: that is too far: after 4.00 m face 1 h");
  EXPECT_PRED2(begins_with, refused("  - move_wall: {room: room 1, face: 4, by: -2}\n"),
               "3:5: door 1 would reach beyond its wall, face 3 of 'room 1' | chang");
  EXPECT_PRED2(begins_with, refused("  - set_ceiling: {room: room 1, height: 1.9}\n"),
               "3:5: door 1 would reach beyond its wall, face 3 of 'room 1'");
  EXPECT_PRED2(begins_with,
               refused("  - add_opening: {room: room 1, face: 3, kind: door, distance: 2.5, width: 0.9, height: 2}\n"),
               "3:64: the opening leaves its wall, face 3 of 'room 1' | ");
  EXPECT_EQ(refused("  - add_opening: {room: room 1, face: 3, kind: door, distance: 1, width: 0.9, height: 2}\n"),
            "3:64: the opening overlaps door 1 | that one is from 1.60 to 2.50 m along face 3, from its left corner");
  EXPECT_EQ(refused("  - add_opening: {room: room 1, face: 3, kind: window, distance: 0.1, width: 0.9, height: 1}\n"),
            "3:5: 'sill' of a window is missing | its lower edge over the foot of the wall, as in sill: 90 cm");
  EXPECT_PRED2(begins_with, refused("  - change_opening: {opening: door 1, by: 0.1}\n"),
               "3:31: door 1 is seen from two sides, and left and ");
  EXPECT_PRED2(begins_with, refused("  - split_room: {room: room 1, from: [5, 0], to: [5, 1], names: [A, B]}\n"),
               "3:38: the line does not cross 'room 1' exactly ");
  EXPECT_PRED2(begins_with, refused("  - split_room: {room: room 1, from: [2, 0], to: [2, 1], names: [A, B]}\n"),
               "3:5: window 1 would reach beyond its wall");
  EXPECT_PRED2(begins_with, refused("  - drop_face: {room: room 1, face: 5}\n"),
               "3:5: it is not clear what comes in the place of face 5: t");
}

TEST_F(Corrections, RoomsThatShareNoWallAreNotMerged) {
  BoxBuilding b;
  b.room(0, 0, 4, 3);
  b.room(5, 0, 7, 3);
  EXPECT_EQ(refused("  - merge_rooms: {rooms: [room 1, room 2]}\n", b.building),
            "3:26: 'room 1' and 'room 2' share no wall | no two of their walls are back to back at most 0.60 m apart");
}

TEST_F(Corrections, AnOpeningBeforeTwoRoomsIsRefused) {
  BoxBuilding b;
  b.room(0, 0, 4, 6);
  b.room(4.1, 0, 7, 2.9);
  b.room(4.1, 3, 7, 6);
  const std::string text = refused(
      "  - add_opening: {room: room 1, face: 3, kind: door, distance: 2.5, width: 0.9, height: 2}\n", b.building);
  EXPECT_PRED2(begins_with, text, "3:64: the opening lies only partly before face 17 of 'room 3' | that wal") << text;
}

TEST_F(Corrections, TheSchemaHasTheKeysThatAreRead) {
  const auto schema = nlohmann::json::parse(test::read_text(ATRIUM_SOURCE_DIR "/share/schema/corrections.schema.json"));
  const auto& all = schema["properties"]["corrections"]["items"]["properties"];
  EXPECT_EQ(all.size(), correction_rules().size());
  for (const auto& rule : correction_rules()) {
    ASSERT_TRUE(all.contains(rule.name)) << rule.name;
    std::set<std::string> keys, listed;
    for (const auto* some : {&rule.required, &rule.optional, &rule.one_of, &rule.at_least_one})
      keys.insert(some->begin(), some->end());
    for (const auto& entry : all[std::string(rule.name)]["properties"].items()) listed.insert(entry.key());
    EXPECT_EQ(listed, keys) << rule.name;
    EXPECT_EQ(all[std::string(rule.name)]["required"].get<std::vector<std::string>>(),
              std::vector<std::string>(rule.required.begin(), rule.required.end()));
  }
}

}  // namespace
}  // namespace atrium::building::correct_refused_test
