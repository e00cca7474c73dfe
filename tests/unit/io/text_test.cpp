#include <cmath>

#include "files.hpp"
#include "modules/io/read_scan.hpp"

namespace atrium::io::text_test {
namespace {

class Text : public Files {
 protected:
  Cloud read(const std::string& text, const std::string& name = "a.xyz") {
    ReadScan::Params params;
    params.path.path = file(name, text);
    return ReadScan::run({}, params, context).cloud;
  }
  std::string failure(const std::string& text, const std::string& name = "a.xyz") {
    return error_of([&] { read(text, name); });
  }
};

TEST_F(Text, ReadsEverySeparatorCommentsAndBlankLines) {
  for (const std::string separator : {" ", "\t", ",", ";", " , ", "  "}) {
    std::string text = "# made by hand\r\n\r\n";
    for (int i = 0; i < 4; ++i)
      text += std::to_string(i) + separator + "-2.5e1" + separator + "+3.25" + (i == 3 ? "" : "\r\n");
    const Cloud cloud = read(text);
    ASSERT_EQ(cloud.size(), 4U) << separator;
    EXPECT_EQ(cloud.points[3], Eigen::Vector3f(3, -25, 3.25F));
  }
}

TEST_F(Text, TellsTheColumnsByTheirNumber) {
  const auto rows = [](const std::string& row) { return row + "\n" + row + "\n" + row + "\n"; };
  EXPECT_EQ(read(rows("1 2 3 0.5")).intensities.at(0), 0.5F);
  EXPECT_EQ(read(rows("1 2 3 10 20 30")).colours.at(0), (Colour{10, 20, 30}));
  EXPECT_EQ(read(rows("1 2 3 0.6 0 -0.8")).normals.at(0), Eigen::Vector3f(0.6F, 0, -0.8F));
  EXPECT_TRUE(read(rows("1 2 3 0.6 0 -0.8")).colours.empty());
  const Cloud seven = read(rows("1 2 3 -1200 10 20 30"), "a.pts");
  EXPECT_EQ(seven.intensities.at(0), -1200.0F);
  EXPECT_EQ(seven.colours.at(0), (Colour{10, 20, 30}));
  for (const std::string row : {"1 2 3 10 20 30 0 1 0", "1 2 3 0 1 0 10 20 30"}) {
    const Cloud nine = read(rows(row));
    EXPECT_EQ(nine.colours.at(0), (Colour{10, 20, 30}));
    EXPECT_EQ(nine.normals.at(0), Eigen::Vector3f(0, 1, 0));
  }
  const Cloud ten = read(rows("1 2 3 9 10 20 30 0 1 0"));
  EXPECT_EQ(ten.intensities.at(0), 9.0F);
  EXPECT_EQ(ten.normals.at(0), Eigen::Vector3f(0, 1, 0));
  EXPECT_CONTAINS(failure(rows("1 2 3 4 5")), "a.xyz:1: 5 columns without names");
  EXPECT_CONTAINS(failure(rows("1 2")), "2 columns without names");
}

TEST_F(Text, TakesTheColumnsFromTheirNames) {
  const std::string rows = "7,1,0,2,3,0.5\n7,4,0,5,6,0.5\n7,7,0,8,9,0.5\n";
  const Cloud csv = read("time,\"X\",odd,Y,Z,Scalar_Intensity\r\n" + rows, "a.csv");
  ASSERT_EQ(csv.size(), 3U);
  EXPECT_EQ(csv.points[2], Eigen::Vector3f(7, 8, 9));
  EXPECT_EQ(csv.intensities[0], 0.5F);
  const Cloud commented = read("//X Y Z label\n1 2 3 4\n1 2 3 5\n1 2 3 6\n");
  EXPECT_EQ(commented.labels, (std::vector<std::int32_t>{4, 5, 6}));
  EXPECT_CONTAINS(failure("a,b,c\n1,2,3\n", "a.csv"), "a.csv:1: neither numbers nor column names");
  EXPECT_CONTAINS(failure("x,y,z\n", "a.csv"), "no points after the line of column names");
  EXPECT_CONTAINS(failure("x,y,z\n1,2,3,4\n", "a.csv"), "a.csv:2: 3 columns are named, but the line has 4 values");
}

TEST_F(Text, ReadsThePtsCount) {
  EXPECT_EQ(read("3\n1 2 3\n4 5 6\n7 8 9\n", "a.pts").size(), 3U);
  EXPECT_CONTAINS(failure("4\n1 2 3\n4 5 6\n7 8 9\n", "a.pts"), "a.pts:1: 4 points are declared, but 3 lines follow");
}

TEST_F(Text, NamesWhatIsWrongAndWhere) {
  EXPECT_CONTAINS(failure("1 2 3\n4 5 6\n7 8\n"), "a.xyz:3: 2 values instead of 3");
  EXPECT_CONTAINS(failure("1 2 3\n4 5 6 7\n7 8 9\n"), "a.xyz:2: more than 3 values: '7' follows");
  EXPECT_CONTAINS(failure("1 2 3\n4 5 six\n7 8 9\n"), "a.xyz:2: 'six' is not a number");
  EXPECT_CONTAINS(failure("1,5;2,5;3,5\n1,5;2,5;3,5\n1,5;2,5;3,5\n"), "decimal commas");
  EXPECT_CONTAINS(failure("# nothing\n\n"), "no points");
  EXPECT_CONTAINS(failure(std::string("1 2\0003", 5)), "not a text file");
  EXPECT_CONTAINS(failure("1 2 3\n"), "only 1 points");
  EXPECT_CONTAINS(failure("1 2 3\n", "a.docx"), "unknown format '.docx'");
}

TEST_F(Text, BrokenNumbersOfOldProgramsAreNotFinite) {
  EXPECT_EQ(read("1 2 3\n-1.#IND 2 3\nNaN 1 1\n1e999 0 0\n1e-999 0 0\n4 5 6\n").size(), 3U);
  EXPECT_TRUE(warned("3 of 6 points dropped")) << warnings();
}

TEST_F(Text, SaysWhenManyPointsLieOnOthers) {
  std::string apart;
  std::string together;
  for (int i = 0; i < 50000; ++i) {
    apart += std::to_string(0.001 * i) + " 1 2\n";
    together += std::to_string(0.001 * (i % 30000)) + " 1 2\n";
  }
  read(apart);
  EXPECT_TRUE(host->warnings.empty()) << warnings();
  read(together);  // 20000 of 50000
  ASSERT_TRUE(warned("% of the points lie exactly on others")) << warnings();
  const std::string text = warnings();
  EXPECT_NEAR(std::stod(text.substr(text.find("about ") + 6)), 40.0, 2.0);
}

TEST_F(Text, PiecesAreJoinedInOrder) {
  // Several megabytes, so several pieces; the lines have different lengths.
  std::string text;
  constexpr int n = 300000;
  for (int i = 0; i < n; ++i) text += std::to_string(i) + " " + std::to_string(0.25 * (i % 7)) + " 1\n";
  const Cloud cloud = read(text);
  ASSERT_EQ(cloud.size(), static_cast<std::size_t>(n));
  bool right = true;
  for (int i = 0; i < n; ++i) right = right && cloud.origin.x() + cloud.points[static_cast<std::size_t>(i)].x() == i;
  EXPECT_TRUE(right);
  // The first error in the file is the one that is told.
  std::string broken = text;
  broken.replace(broken.find("\n250000 "), 4, "\nx50");
  broken.replace(broken.find("\n9000 "), 4, "\ny00");
  EXPECT_CONTAINS(failure(broken), "a.xyz:9001: 'y000' is not a number");
}

}  // namespace
}  // namespace atrium::io::text_test
