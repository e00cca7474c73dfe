#include <cmath>

#include "files.hpp"
#include "modules/io/read_scan.hpp"

namespace atrium::io::text_test {
namespace {

class Text : public Files {
 protected:
  Cloud read(const std::string& text, const std::string& name = "a.xyz") {
    ReadScan::Params params;
    params.path = {{file(name, text)}};
    params.unit = unit;
    return ReadScan::run(params, context).cloud;
  }
  ReadScan::Unit unit = ReadScan::Params{}.unit;
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
  EXPECT_CONTAINS(failure("# nothing\n\n"), "no points");
  EXPECT_CONTAINS(failure(std::string("1 2\0003", 5)), "not a text file");
  EXPECT_CONTAINS(failure("1 2 3\n"), "only 1 point");
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

TEST_F(Text, DecimalCommasAreReadWhereNothingElseIsMeant) {
  for (const std::string separator : {" ", "\t", ";", "  ", "; "}) {
    SCOPED_TRACE(separator);
    std::string text;
    for (const std::string row : {"0,500 1,250 0,125", "4,750 -1,5 2,500", "7 2,250 0,750"}) {
      for (const char c : row) text += c == ' ' ? separator : std::string(1, c);
      text += "\r\n";
    }
    const Cloud cloud = read(text);
    ASSERT_EQ(cloud.size(), 3U);
    EXPECT_EQ(cloud.points[1], Eigen::Vector3f(4.75F, -1.5F, 2.5F));
    EXPECT_EQ(cloud.points[2], Eigen::Vector3f(7, 2.25F, 0.75F));
  }
  const Cloud coloured = read("0,5 1,25 0,125 200 60 61\n4,75 1,5 2,5 60 200 60\n1 1 1 9 9 9\n");
  EXPECT_EQ(coloured.colours.at(0), (Colour{200, 60, 61}));
  EXPECT_EQ(read("1,2,3\n4,5,6\n7,8,9\n").points.at(1), Eigen::Vector3f(4, 5, 6));
  EXPECT_EQ(read("1, 2, 3\n4, 5, 6\n7, 8, 9\n").points.at(1), Eigen::Vector3f(4, 5, 6));
}

TEST_F(Text, EmptyFieldsShiftNothing) {
  const Cloud cell = read(
      "x,y,z,intensity,r,g,b\n0.5,1.25,0.125,7,200,60,60\n4.75,1.5,2.5,,60,200,60\n7,2.25,0.75,7,60,60,200\n", "a.csv");
  EXPECT_EQ(cell.intensities, (std::vector<float>{7, 0, 7}));
  EXPECT_EQ(cell.colours.at(1), (Colour{60, 200, 60}));
  for (const std::string end : {"", ","}) {  // pandas: a column of row numbers without a name
    const Cloud pandas = read(",x,y,z" + (end.empty() ? "" : end + "label") + "\n0,0.5,1.25,0.125" + end +
                                  "\n1,4.75,1.5,2.5" + end + "\n2,7,2.25,0.75" + end + "\n",
                              "a.csv");
    ASSERT_EQ(pandas.size(), 3U);
    EXPECT_EQ(pandas.points[1], Eigen::Vector3f(4.75F, 1.5F, 2.5F));
    EXPECT_EQ(pandas.labels, end.empty() ? std::vector<std::int32_t>{} : std::vector<std::int32_t>(3, -1));
  }
  EXPECT_EQ(read("1;2;3;\n4;5;6;\n7;8;9;\n").points.at(2), Eigen::Vector3f(7, 8, 9));
  EXPECT_EQ(read("x,y,z\n1,2,3,\n4,5,6,\n7,8,9,\n").size(), 3U);
  EXPECT_EQ(read("1,2,3\n,5,6\n7,8,9\n3,3,3\n").size(), 3U);
  EXPECT_TRUE(warned("1 of 4 points dropped"));
}

TEST_F(Text, NamesMayHaveBlanksUnitsAndQuotes) {
  const Cloud cloud = read(
      "\"Point ID\";\"X [m]\";\"Y [m]\";\"Z (m)\";\"Illuminance (PCV)\";Rf;Gf;Bf\n"
      "A-1;1;2;3;0.5;1;0;0.2\nA-2;4;5;6;0.5;0;1;0\nA-3;7;8;9;0.5;0;0;1\n",
      "a.csv");
  ASSERT_EQ(cloud.size(), 3U);
  EXPECT_EQ(cloud.points[1], Eigen::Vector3f(4, 5, 6));
  EXPECT_EQ(cloud.colours[0], (Colour{255, 0, 51}));
  const Cloud tabs = read("Point ID\tX\tY\tZ\n1\t1\t2\t3\n2\t4\t5\t6\n3\t7\t8\t9\n");
  EXPECT_EQ(tabs.points.at(2), Eigen::Vector3f(7, 8, 9));
  EXPECT_EQ(read("X [m] Y [m] Z [m]\n1 2 3\n4 5 6\n7 8 9\n").points.at(2), Eigen::Vector3f(7, 8, 9));
}

TEST_F(Text, WhatCouldBeSomethingElseIsSaid) {
  const Cloud label = read("0.5 1.25 0.125 200 60 60 0\n4.75 1.5 2.5 60 200 60 1\n7 2.25 0.75 60 60 200 2\n");
  EXPECT_EQ(label.labels, (std::vector<std::int32_t>{0, 1, 2}));
  EXPECT_EQ(label.colours.at(1), (Colour{60, 200, 60}));
  EXPECT_TRUE(warned("taken for x y z r g b label")) << warnings();
  const Cloud numbered = read("0 0.5 1.25 0.125\n1 4.75 1.5 2.5\n2 7 2.25 0.75\n3 1 0.5 2\n");
  EXPECT_EQ(numbered.points.at(1), Eigen::Vector3f(4.75F, 1.5F, 2.5F));
  EXPECT_TRUE(numbered.intensities.empty());
  EXPECT_TRUE(warned("taken for - x y z: the first one counts the rows")) << warnings();
}

TEST_F(Text, PtsOfSeveralScans) {
  const Cloud cloud =
      read("3\n1 2 3 -9 10 20 30\n4 5 6 0 1 2 3\n7 8 9 1 4 5 6\n0\n2\n1 1 1 5 7 8 9\n2 2 2 6 255 0 1\n", "a.pts");
  ASSERT_EQ(cloud.size(), 5U);
  EXPECT_EQ(cloud.points[4], Eigen::Vector3f(2, 2, 2));
  EXPECT_EQ(cloud.intensities, (std::vector<float>{-9, 0, 1, 5, 6}));
  EXPECT_EQ(cloud.colours[4], (Colour{255, 0, 1}));
  EXPECT_EQ(read("3\n1 2 3\n4 5 6\n7 8 9\n0\n", "a.pts").size(), 3U);
  EXPECT_TRUE(host->warnings.empty()) << warnings();
  EXPECT_EQ(read("2\n1 2 3\n4 5 6\n7 8 9\n1\n2 2 2\n", "a.pts").size(), 4U);
  EXPECT_TRUE(warned("a.pts:1: 2 points are declared, but 3 lines follow: all are read")) << warnings();
  EXPECT_CONTAINS(failure("2\n1 2 3\n4 5 6\n2\n7 8 9\n", "a.pts"),
                  "a.pts:4: 2 points are declared, but 1 line follows");
  EXPECT_CONTAINS(failure("2\n1 2 3\n4 5 6\n1\n7 8\n", "a.pts"),
                  "a.pts:5: 2 values a point, where the file's other scans have 3");
  const Cloud mixed = read("1\n1 2 3 -9\n2\n1 1 1 5 7 8 9\n2 2 2 6 255 0 1\n1\n7 8 9\n", "a.pts");
  EXPECT_EQ(mixed.intensities, (std::vector<float>{-9, 5, 6, 0}));
  EXPECT_EQ(mixed.colours, (std::vector<Colour>{{0, 0, 0}, {7, 8, 9}, {255, 0, 1}, {0, 0, 0}}));
  EXPECT_TRUE(warned("a.pts: 2 of 3 scans have fewer columns than x y z intensity r g b: what they lack is 0"));
}

TEST_F(Text, NamesMayGiveTheUnit) {
  unit = ReadScan::Unit::automatic;
  const std::string rows = "\n0 0 0\n10 0 0\n10 5 0\n0 5 8\n";
  EXPECT_FLOAT_EQ(read("X [ft] Y [ft] Z [ft]" + rows).points.at(1).x(), 3.048F);
  EXPECT_TRUE(warned("its unit is 0.3048 m, as the file says")) << warnings();
  EXPECT_FLOAT_EQ(read("# x(mm) y(mm) z(mm)" + rows).points.at(1).x(), 0.01F);
  EXPECT_FLOAT_EQ(read("x[m] y[m] z[mm]" + rows).points.at(1).x(), 10);  // they contradict each other
  EXPECT_FLOAT_EQ(read("x y z range[ft]\n0 0 0 1\n10 0 0 1\n10 5 0 1\n0 5 8 1\n").points.at(1).x(), 10) << "another's";
  EXPECT_FLOAT_EQ(read("\"Easting\",\"Northing\",\"Elevation\"\n0,0,0\n10,0,0\n10,5,0\n0,5,8\n").points.at(1).x(), 10);
  EXPECT_FLOAT_EQ(read("X (ft) Y (ft) Z (ft) Time [m]\n0 0 0 1\n10 0 0 1\n10 5 0 1\n0 5 8 1\n").points.at(1).x(),
                  3.048F);
}

std::string ptx_head(int columns, int rows, const std::string& place, const std::string& matrix) {
  return std::to_string(columns) + "\n" + std::to_string(rows) + "\n" + place + "\n1 0 0\n0 1 0\n0 0 1\n" + matrix;
}
const char* const still = "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";

TEST_F(Text, PtxScansStandWhereTheirMatricesSay) {
  // A quarter turn about z, then a shift, as rows: p' = p · M.
  const std::string turned = "0 1 0 0\n-1 0 0 0\n0 0 1 0\n500000.5 20 3 1\n";
  const std::string points = "1 0 0 0.5 10 20 30\n0 0 0 0 0 0 0\n0 2 0 0.25 40 50 60\n0 0 1 1 255 0 9\n";
  const std::string text = ptx_head(2, 2, "500000.5 20 3", turned) + points + ptx_head(1, 4, "7 8 9", still) + points;
  for (const std::string name : {"a.ptx", "grids.asc"}) {
    const Cloud cloud = read(text, name);
    ASSERT_EQ(cloud.size(), 6U);
    EXPECT_NEAR(cloud.origin.x() + cloud.points[0].x(), 500000.5, 1e-4);
    EXPECT_NEAR(cloud.origin.y() + cloud.points[0].y(), 21, 1e-4);
    EXPECT_NEAR(cloud.origin.x() + cloud.points[1].x(), 499998.5, 1e-4);
    EXPECT_NEAR(cloud.origin.x() + cloud.points[3].x(), 1, 0.04);
    EXPECT_EQ(cloud.colours[5], (Colour{255, 0, 9}));
    EXPECT_EQ(cloud.intensities, (std::vector<float>{0.5F, 0.25F, 1, 0.5F, 0.25F, 1}));
    EXPECT_EQ(cloud.source, (std::vector<std::uint16_t>{0, 0, 0, 1, 1, 1}));
    ASSERT_EQ(cloud.sensors.size(), 2U);
    EXPECT_NEAR(cloud.origin.x() + cloud.sensors[0].x(), 500000.5, 1e-4);
    EXPECT_NEAR(cloud.origin.y() + cloud.sensors[1].y(), 8, 1e-4);
  }
}

TEST_F(Text, PtxScansMayLackColours) {
  const std::string grey = "1 0 0 0.5\n1 1 0 0.5\n", coloured = "0 2 0 0.25 40 50 60\n0 0 1 1 255 0 9\n";
  const Cloud cloud = read(ptx_head(1, 2, "0 0 0", still) + grey + ptx_head(2, 1, "1 1 1", still) + coloured, "a.ptx");
  EXPECT_EQ(cloud.colours, (std::vector<Colour>{{0, 0, 0}, {0, 0, 0}, {40, 50, 60}, {255, 0, 9}}));
  EXPECT_EQ(cloud.intensities, (std::vector<float>{0.5F, 0.5F, 0.25F, 1}));
  EXPECT_TRUE(warned("1 of 2 scans have fewer columns")) << warnings();
}

TEST_F(Text, ColoursOfScansMayBeFractions) {
  const std::string points = "1 0 0 0.5 1 0.5 0\n1 1 0 0.5 0 0 1\n0 2 0 0.25 0.2 0.4 0.6\n0 0 1 1 1 1 1\n";
  const Cloud cloud = read(ptx_head(2, 2, "0 0 0", still) + points, "a.ptx");
  EXPECT_EQ(cloud.colours, (std::vector<Colour>{{255, 128, 0}, {0, 0, 255}, {51, 102, 153}, {255, 255, 255}}));
}

TEST_F(Text, PtxThatDoesNotFitTogetherIsRefused) {
  const std::string points = "1 0 0 0.5\n1 1 0 0.5\n0 2 0 0.25\n0 0 1 1\n";
  EXPECT_EQ(read(ptx_head(2, 2, "0 0 0", still) + points, "a.ptx").size(), 4U);
  EXPECT_CONTAINS(failure(ptx_head(2, 3, "0 0 0", still) + points, "a.ptx"),
                  "a.ptx:1: cut short: 2 × 3 points are promised, but 4 lines follow");
  EXPECT_CONTAINS(failure(ptx_head(2, 2, "0 0 0", still) + points + "3\n", "a.ptx"), "a.ptx:15: cut short");
  EXPECT_CONTAINS(failure(ptx_head(-2, 2, "0 0 0", still) + points, "a.ptx"), "a.ptx:1: '-2' is no number of columns");
  EXPECT_CONTAINS(failure(ptx_head(2, 2, "0 nan 0", still) + points, "a.ptx"), "a.ptx:3: the scanner's place");
  EXPECT_CONTAINS(failure(ptx_head(2, 2, "0 0 0", "0 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n") + points, "a.ptx"),
                  "a.ptx:7: the matrix flattens");
  EXPECT_CONTAINS(failure(ptx_head(2, 2, "0 0 0", still) + "1 0 0 0.5\n1 1 0\n0 2 0 0.25\n0 0 1 1\n", "a.ptx"),
                  "a.ptx:12: 3 values instead of 4");
  EXPECT_CONTAINS(failure(ptx_head(0, 7, "0 0 0", still), "a.ptx"), "no points");
}

TEST_F(Text, FormatsOfMakersSayWhatToExport) {
  for (const std::string name : {"a.rcp", "a.RCS", "a.fls", "a.zfs", "a.lgs", "a.rvt"}) {
    EXPECT_CONTAINS(failure("x", name), "which only its maker's programs read");
    try {
      read("x", name);
    } catch (const Error& e) {
      EXPECT_CONTAINS(e.help(), "export the scan as E57 from ");
    }
  }
}

}  // namespace
}  // namespace atrium::io::text_test
