#pragma once
#include <gtest/gtest.h>

#include <algorithm>

#include "houses.hpp"
#include "modules/building/correct.hpp"
#include "modules/building/room_shell.hpp"
#include "modules/layout/mesh.hpp"
#include "modules/metric/validity.hpp"
#include "modules/types/building_rules.hpp"
#include "tests/support/temporary_folder.hpp"
#include "writing_host.hpp"

namespace atrium::test {

/// Two rooms, 4 m × 3 m and 2.88 m × 3 m, 2.5 m high, with 12 cm of wall from x = 4; faces 0 … 5 and 6 … 11 are floor,
/// ceiling, and the walls at y0, x1, y1, x0.
class Corrections : public ::testing::Test {
 protected:
  test::TemporaryFolder folder;
  std::shared_ptr<test::WritingHost> host = std::make_shared<test::WritingHost>();

  Building corrected(const Building& building, const std::string& lines, const Transform& transform = {},
                     double unit = 1) {
    const auto file = folder / "corrections.yaml";
    test::write_text(file, "atrium_corrections: 1\ncorrections:\n" + lines);
    Context context{1, host};
    Cloud cloud;
    cloud.unit = unit;
    const auto out =
        building::Correct::run({input(building), input(transform), input(cloud)}, {{{file.string()}}}, context);
    check(*out.building);
    expect_closed_rooms(out.building);
    return *out.building;
  }
  /// Each room's surface is one closed 2-manifold without crossings.
  static void expect_closed_rooms(const std::shared_ptr<const Building>& building) {
    Context context;
    const Mesh shell = layout::Mesh::run({building, {}}, {}).shell;
    metric::Validity::Params params;
    params.listed = 0;
    for (std::size_t r = 0; r < building->rooms.size(); ++r) {
      Mesh mesh = shell;
      mesh.triangles.clear();
      for (std::size_t t = 0; t < shell.triangles.size(); ++t)
        if (building->faces[static_cast<std::size_t>(shell.primitives[t])].room == static_cast<std::int32_t>(r))
          mesh.triangles.push_back(shell.triangles[t]);
      mesh.classes.resize(mesh.triangles.size());
      mesh.storeys.resize(mesh.triangles.size());
      mesh.primitives.resize(mesh.triangles.size());
      for (const auto& m : metric::Validity::run({input(mesh)}, params, context).metrics.values) {
        if (m.name == "validity.components" || m.name == "validity.components.watertight") {
          EXPECT_EQ(m.value, 1) << m.name;
        }
        for (const char* none : {"degenerate_faces", "edges.boundary", "edges.non_manifold", "edges.misoriented",
                                 "vertices.non_manifold", "self_intersections.crossing"}) {
          if (m.name != std::string("validity.") + none) continue;
          EXPECT_EQ(m.value, 0) << m.name;
        }
      }
    }
  }
  /// What the error says after the file's name, and its help.
  std::string refused(const std::string& lines, const Building& building = BoxBuilding::two_rooms()) {
    try {
      corrected(building, lines);
    } catch (const Error& error) {
      const std::string text = error.what();
      const std::string name = (folder / "corrections.yaml").string() + ":";
      EXPECT_EQ(text.substr(0, name.size()), name);
      return text.substr(name.size()) + " | " + error.help();
    }
    return "nothing was refused";
  }

  static const BuildingRoom& room(const Building& building, const std::string& name) {
    const auto found =
        std::find_if(building.rooms.begin(), building.rooms.end(), [&](const auto& r) { return r.name == name; });
    if (found == building.rooms.end()) throw std::runtime_error("no room " + name);
    return *found;
  }

  static void expect_room(const Building& building, const std::string& name, double area, double volume,
                          std::size_t faces) {
    const BuildingRoom& of = room(building, name);
    EXPECT_NEAR(of.area, area, 1e-9) << name;
    EXPECT_NEAR(of.volume, volume, 1e-9) << name;
    EXPECT_NEAR(of.height, volume / area, 1e-9) << name;
    EXPECT_EQ(of.faces.size(), faces) << name;
    std::vector<BuildingFace> own;
    for (const auto f : of.faces) {
      own.push_back(building.faces[static_cast<std::size_t>(f)]);
      EXPECT_EQ(&building.rooms[static_cast<std::size_t>(own.back().room)], &of);
      for (const auto v : own.back().outline)
        EXPECT_NEAR(own.back().plane.signed_distance(building.vertices[v]), 0, 1e-9) << name << ", face " << f;
    }
    EXPECT_TRUE(building::is_closed(own)) << name;
    EXPECT_EQ(building::parts_of(own), 1U) << name;
  }

  static void expect_box(const std::vector<Eigen::Vector3d>& places, const Eigen::Vector3d& low,
                         const Eigen::Vector3d& high) {
    Eigen::AlignedBox3d box;
    for (const auto& p : places) box.extend(p);
    EXPECT_LT((box.min() - low).norm(), 1e-9) << box.min().transpose();
    EXPECT_LT((box.max() - high).norm(), 1e-9) << box.max().transpose();
  }

  static bool begins_with(const std::string& text, const std::string& beginning) {
    return text.rfind(beginning, 0) == 0;
  }

  static bool says(const BuildingRoom& room, const std::string& text) {
    return std::find(room.doubts.begin(), room.doubts.end(), "corrected by hand: " + text) != room.doubts.end();
  }
};

}  // namespace atrium::test
