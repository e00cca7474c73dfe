// What is packed into the page that shows one run.
#include <gtest/gtest.h>

#include <array>

#include "graph/report/thinned_points.hpp"
#include "graph/report/view.hpp"
#include "runs.hpp"

namespace atrium::test::view_parts_test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

report::View packed(const fs::path& folder, const std::vector<report::ViewWish>& parts, std::size_t room = 1'000'000) {
  return report::pack_view(report::read_run(folder), {parts, {}}, room);
}

/// Its accessors' rows, as numbers.
std::vector<std::vector<std::array<unsigned, 3>>> rows_of(const std::string& glb) {
  const auto number = [&](std::size_t at, int size) {
    std::size_t value = 0;
    for (int i = size; i-- > 0;)
      value = value << 8U | static_cast<unsigned char>(glb.at(at + static_cast<std::size_t>(i)));
    return value;
  };
  EXPECT_EQ(number(8, 4), glb.size());
  const std::size_t length = number(12, 4);
  const json description = json::parse(glb.substr(20, length));
  EXPECT_EQ(number(20 + length, 4), description["buffers"][0]["byteLength"]);
  std::vector<std::vector<std::array<unsigned, 3>>> result;
  for (const auto& accessor : description["accessors"]) {
    const json& view = description["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    const std::size_t offset = accessor["byteOffset"], count = accessor["count"];
    EXPECT_LE(offset + 8 * count, view["byteLength"].get<std::size_t>());
    auto& rows = result.emplace_back();
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t at = 28 + length + view.value("byteOffset", std::size_t{0}) + offset + 8 * i;
      rows.push_back({static_cast<unsigned>(number(at, 2)), static_cast<unsigned>(number(at + 2, 2)),
                      static_cast<unsigned>(number(at + 4, 2))});
    }
  }
  return result;
}

TEST(ViewParts, HaveTheFirstOfTheWishedFilesThatIsThere) {
  const TemporaryFolder folder;
  make_run(folder / "run", {{"b.csv", "2"}, {"sub/c.csv", "3"}, {"d.svg", "4"}});
  const auto view = packed(folder / "run", {{"one", {"a.csv", "b.csv"}, "x.y"},
                                            {"other", {"c.csv"}, "x.y"},
                                            {"by type", {"plan.svg"}, "a.b"},
                                            {"none", {"plan.glb"}, "a.b"},
                                            {"nobody", {"e.json"}, "x.y"}});
  ASSERT_EQ(view.parts.size(), 5U);
  EXPECT_EQ(view.parts[0].path, "b.csv");
  EXPECT_EQ(view.parts[1].path, "sub/c.csv");
  EXPECT_EQ(view.parts[2].path, "d.svg") << "of another name, by the node type that wrote it";
  EXPECT_EQ(view.parts[3].lacking, "plan.glb is lacking: a.b writes it; in this run 'n' wrote other files");
  EXPECT_EQ(view.parts[4].lacking, "e.json is lacking: x.y writes it, and this run has no such node");
  EXPECT_EQ(view.lacking, 2U);
  EXPECT_EQ(view.files.size(), 3U);
}

TEST(ViewParts, SayWhyTheyAreLacking) {
  const TemporaryFolder folder;
  make_run(folder / "run", {{"gone.csv", "1"}, {"large.csv", std::string(200'000, 'x') + "12345"}});
  fs::remove(folder / "run/gone.csv");
  const auto view = packed(folder / "run", {{"gone", {"gone.csv"}, "a.b"}}, 100);
  EXPECT_NE(view.parts[0].lacking.find("gone.csv is not in the run's folder any more"), std::string::npos);
  std::string noise;
  std::uint32_t state = 1;
  for (int i = 0; i < 100'000; ++i) noise += static_cast<char>((state = state * 1664525U + 1013904223U) >> 24U);
  write_text(folder / "run/large.csv", noise);
  const auto large = packed(folder / "run", {{"large", {"large.csv"}, "a.b"}}, 20'000);
  EXPECT_NE(large.parts[0].lacking.find("has room for 0.0 MB: --max-size gives more"), std::string::npos)
      << large.parts[0].lacking;
  EXPECT_TRUE(large.files.empty());
  make_run(folder / "failed", {}, "failed");
  const auto failed = packed(folder / "failed", {{"plan", {"plan.svg"}, "a.b"}});
  EXPECT_EQ(failed.parts[0].lacking, "plan.svg is lacking: a.b writes it; in this run 'n' failed: no disk </script>");
}

TEST(ViewParts, NeverComeFromOutsideOfTheRunsFolder) {
  const TemporaryFolder folder;
  write_text(folder / "secret.csv", "secret");
  make_run(folder / "run", {});
  json manifest = json::parse(read_text(folder / "run/manifest.json"));
  manifest["nodes"][0]["artefacts"] = {{{"path", "../secret.csv"}, {"bytes", 6}}};
  write_text(folder / "run/manifest.json", manifest.dump());
  const auto view = packed(folder / "run", {{"secret", {"secret.csv"}, "a.b"}});
  EXPECT_TRUE(view.files.empty());
}

TEST(ViewParts, NameTheNodeThatWroteThem) {
  const TemporaryFolder folder;
  make_run(folder / "run", {{"model.ply", "1"}});
  EXPECT_EQ(packed(folder / "run", {{"model", {"model.ply"}, "x.y"}}).parts[0].node, "n");
  json manifest = json::parse(read_text(folder / "run/manifest.json"));
  manifest["nodes"][0]["artefacts"] = json::array();
  write_text(folder / "run/manifest.json", manifest.dump());
  write_text(folder / "run/model.ply", "1");
  for (const auto& part : packed(folder / "run", {{"model", {"model.ply"}, "x.y"}}).parts) EXPECT_EQ(part.node, "");
}

TEST(ThinnedPoints, KeepTheirAttributesAndAreSpreadOverTheFile) {
  const std::string glb = glb_of_points(6000, 2000);
  const auto whole = rows_of(glb);
  const auto thinned = report::thinned_points(glb, 0.25);
  ASSERT_TRUE(thinned);
  EXPECT_EQ(thinned->points, 2000U);
  EXPECT_EQ(thinned->of, 8000U);
  EXPECT_EQ(thinned->glb, report::thinned_points(glb, 0.25)->glb);
  const auto rows = rows_of(thinned->glb);
  ASSERT_EQ(rows.size(), 4U);
  for (const std::size_t tile : {0, 2}) {
    ASSERT_EQ(rows[tile].size(), tile == 0 ? 1500U : 500U);
    ASSERT_EQ(rows[tile + 1].size(), rows[tile].size());
    for (std::size_t i = 0; i < rows[tile].size(); ++i) {
      const unsigned number = rows[tile][i][2], in_tile = number - (tile == 0 ? 0 : 6000);
      EXPECT_EQ(rows[tile + 1][i][2], number) << "a place with another one's colour";
      EXPECT_EQ(rows[tile][i], whole[tile][in_tile]);
      EXPECT_EQ(in_tile / 4, i) << "one of each four";
    }
  }
  EXPECT_EQ(report::thinned_points(glb, 1e-9)->points, 2U) << "one of each tile";
}

TEST(ThinnedPoints, LeaveOtherFilesAlone) {
  const std::string glb = glb_of_points(50, 50);
  EXPECT_TRUE(report::thinned_points(glb, 0.5));
  EXPECT_FALSE(report::thinned_points("ply\n", 0.5));
  EXPECT_FALSE(report::thinned_points("", 0.5));
  EXPECT_FALSE(report::thinned_points(glb.substr(0, glb.size() - 8), 0.5)) << "cut short";
  EXPECT_FALSE(report::thinned_points(glb_of_points(50, 50, R"({"mode": 4})"), 0.5)) << "triangles";
  EXPECT_FALSE(report::thinned_points(glb_of_points(50, 50, R"({"indices": 1})"), 0.5));
  EXPECT_FALSE(report::thinned_points(glb_of_points(50, 50, R"({"attributes": {"COLOR_0": 3}})"), 0.5)) << "shared";
}

TEST(ViewParts, ThinPointsUntilTheyHaveRoom) {
  const TemporaryFolder folder;
  make_run(folder / "run", {{"scan.glb", glb_of_points(60'000, 60'000)}, {"plan.svg", "<svg/>"}});
  const std::vector<report::ViewWish> wishes{{"plan", {"plan.svg"}, "a.b"}, {"scan", {"scan.glb"}, "a.b"}};
  const auto whole = packed(folder / "run", wishes, 10'000'000);
  EXPECT_TRUE(whole.parts[1].note.empty());
  const std::size_t size = whole.files[1].base64.size();
  const auto thinned = packed(folder / "run", wishes, size / 3);
  ASSERT_EQ(thinned.files.size(), 2U);
  EXPECT_LE(thinned.files[0].base64.size() + thinned.files[1].base64.size(), size / 3);
  EXPECT_GT(thinned.files[1].base64.size(), size / 4) << "more points had room";
  EXPECT_NE(thinned.parts[1].note.find("of its 120000 points are in the page"), std::string::npos)
      << thinned.parts[1].note;
  EXPECT_EQ(packed(folder / "run", wishes, size / 3).files[1].base64, thinned.files[1].base64);
  const auto none = packed(folder / "run", wishes, 2000);
  EXPECT_EQ(none.files.size(), 1U) << "a handful of points is no scan";
  EXPECT_NE(none.parts[1].lacking.find("--max-size gives more"), std::string::npos);
}

TEST(ViewParts, OfAGigabyteAreNotReadToBeThinned) {
  const TemporaryFolder folder;
  make_run(folder / "run", {{"scan.glb", "glTF"}});
  fs::resize_file(folder / "run/scan.glb", 1'100'000'000);  // a hole: it takes no place
  const auto view = packed(folder / "run", {{"scan", {"scan.glb"}, "a.b"}}, 25'000'000);
  EXPECT_EQ(view.parts[0].lacking,
            "scan.glb takes 1100.0 MB of the page, which has room for 25.0 MB: --max-size gives more");
}

}  // namespace
}  // namespace atrium::test::view_parts_test
