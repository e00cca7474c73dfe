#include <gtest/gtest.h>

#include <fstream>

#include "files.hpp"
#include "modules/io/decode.hpp"
#include "modules/io/read_scan.hpp"
#include "modules/io/unit_guess.hpp"
#include "modules/io/write_cloud.hpp"
#include "tests/support/rooms.hpp"

namespace atrium::io::unit_test {
namespace {

using Eigen::Vector3d;

void box(test::Rooms& rooms, double x, double y, double wide, double deep, double height) {
  rooms.floor(x, y, x + wide, y + deep, height);
  rooms.wall(x + wide, y, x, y, 0.04, height).wall(x + wide, y + deep, x + wide, y, 0.04, height);
  rooms.wall(x, y + deep, x + wide, y + deep, 0.04, height).wall(x, y, x, y + deep, 0.04, height);
}

/// A room of 5 × 4 × 2.5 m with a table and two seats, in metres; turned by 30 degrees.
std::vector<Eigen::Vector3f> furnished_room() {
  test::Rooms rooms;
  rooms.noise = 0.003;
  rooms.floor(0, 0, 5, 4).ceiling(0, 0, 5, 4).walls({{0, 0}, {5, 0}, {5, 4}, {0, 4}});
  box(rooms, 1.5, 1.8, 1.4, 0.8, 0.74);
  box(rooms, 1.7, 1.2, 0.42, 0.42, 0.45);
  box(rooms, 2.3, 1.2, 0.42, 0.42, 0.45);
  const Transform turn{Eigen::AngleAxisd(0.52, Vector3d::UnitZ()).toRotationMatrix(), Vector3d::Zero()};
  return transformed(*rooms.planes().cloud, turn).points;
}

std::vector<Eigen::Vector3f> empty_hall() {
  test::Rooms rooms;
  rooms.spacing = 0.08;
  rooms.floor(0, 0, 16.4, 13.1).ceiling(0, 0, 16.4, 13.1, 8.2);
  rooms.walls({{0, 0}, {16.4, 0}, {16.4, 13.1}, {0, 13.1}}, 0, 0, 8.2);
  return rooms.planes().cloud->points;
}

std::vector<Eigen::Vector3f> in_units(std::vector<Eigen::Vector3f> points, double metres) {
  for (auto& p : points) p /= static_cast<float>(metres);
  return points;
}

TEST(UnitGuess, FurnitureAndHeightsTellTheUnit) {
  Context context;
  const auto room = furnished_room();
  for (const double metres : {1.0, 0.01, 0.001, 0.0254, 0.3048}) {
    const UnitGuess guess = guess_unit(in_units(room, metres), false, context);
    EXPECT_EQ(guess.metres, metres) << guess.warning;
    EXPECT_EQ(guess.warning.empty(), metres == 1.0) << guess.warning;
  }
}

TEST(UnitGuess, YMayBeUp) {
  Context context;
  auto room = furnished_room();
  for (auto& p : room) p = {p.x(), p.z(), -p.y()};
  EXPECT_EQ(guess_unit(room, false, context).metres, 1.0);
  EXPECT_EQ(guess_unit(in_units(room, 0.3048), false, context).metres, 0.3048);
}

TEST(UnitGuess, AHallStaysAHallWithAWarning) {
  Context context;
  const UnitGuess guess = guess_unit(empty_hall(), false, context);
  EXPECT_EQ(guess.metres, 1.0) << guess.warning;
  EXPECT_CONTAINS(guess.warning, "-s scan.unit=ft");
}

TEST(UnitGuess, FewPointsAreInMetres) {
  Context context;
  EXPECT_EQ(guess_unit({{0, 0, 0}, {9000, 0, 0}, {0, 9000, 0}}, false, context).metres, 1.0);
}

class Units : public Files {};

TEST_F(Units, ReadScanTakesOrFindsTheUnit) {
  Cloud cloud;
  cloud.points = in_units(furnished_room(), 0.3048);
  WriteCloud::run({input(cloud)}, {{"feet.ply"}}, context);
  ReadScan::Params params;
  params.path = {{path("feet.ply")}};
  const auto height = [&] { return bounds_of(ReadScan::run(params, context).cloud.points, context).extent().z(); };
  EXPECT_NEAR(height(), 2.5 / 0.3048, 0.1);  // metres unless it is asked to find out
  params.unit = ReadScan::Unit::automatic;
  EXPECT_NEAR(height(), 2.5, 0.03);
  EXPECT_TRUE(warned("taken to be in feet")) << warnings();
  EXPECT_NEAR(ReadScan::run(params, context).cloud.unit, 0.3048, 1e-12);
  params.unit = ReadScan::Unit::inch;
  EXPECT_NEAR(height(), 2.5 / 12, 0.01);
  params.unit = ReadScan::Unit::automatic;
  params.scale = 0.5;  // a factor is not second-guessed
  EXPECT_NEAR(height(), 2.5 / 0.3048 / 2, 0.1);
}

TEST_F(Units, ObjFilesUsuallyHaveYUp) {
  ReadScan::Params params;
  params.path = {{path("points.obj")}};
  std::ofstream(params.path.front().path) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  EXPECT_TRUE(ReadScan::run(params, context).cloud.y_up);
  params.path = {{path("points.xyz")}};
  std::ofstream(params.path.front().path) << "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  const Cloud cloud = ReadScan::run(params, context).cloud;
  EXPECT_FALSE(cloud.y_up);
  EXPECT_EQ(cloud.unit, 1);
}

}  // namespace
}  // namespace atrium::io::unit_test
