// PDF files are read back by others' programs, poppler's (Debian: poppler-utils); without them these tests are skipped,
// where nobody asks for all checks.
#include "modules/pdf/write_plan.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>
#include <set>
#include <sstream>

#include "modules/floorplan/write_svg.hpp"
#include "tests/support/lacking.hpp"
#include "tests/unit/floorplan/buildings.hpp"

namespace atrium::pdf::write_plan_test {
namespace {

using floorplan::Host;

#define ATRIUM_SKIP_WITHOUT_POPPLER() \
  if (!test::has_program("pdfinfo")) ATRIUM_SKIP_LACKING("poppler-utils is not installed")

class Pdf : public testing::Test {
 protected:
  std::shared_ptr<Host> host = std::make_shared<Host>();
  Context context{1, host};
  std::string file = host->folder / "floorplan.pdf";

  void write(const FloorPlan& plan, const WritePlan::Params& params = {}) {
    WritePlan::run({input(plan)}, params, context);
  }
  std::string told_by(std::vector<std::string> command) const {
    const auto result = test::run_process(command);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    return result.out;
  }
  std::string info() const { return told_by({"pdfinfo", "-f", "1", "-l", "9", file}); }
  std::string text() const { return told_by({"pdftotext", "-layout", file, "-"}); }
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(Pdf, IsTheSheetOfTheSvgInItsSize) {
  ATRIUM_SKIP_WITHOUT_POPPLER();
  write(floorplan::plan_of(floorplan::two_rooms()));
  const std::string about = info();
  EXPECT_TRUE(std::regex_search(about, std::regex("Page +1 size: +841[.]8[0-9]* x 595[.]2[0-9]* pts [(]A4[)]")))
      << about;
  EXPECT_TRUE(std::regex_search(about, std::regex("Pages: +1\n"))) << about;
  EXPECT_TRUE(has(about, "Floor plan")) << "the title";
  const std::string shown = text();
  for (const char* part : {"Floor plan", "1:50", "Room 1", "12.00 m\u00B2", "4.00", "0.12", "2.88", "7.00", "3.00",
                           "dimensions in metres"})
    EXPECT_TRUE(has(shown, part)) << part << " in " << shown;
}

TEST_F(Pdf, HoldsItsFontsAndNoPixels) {
  ATRIUM_SKIP_WITHOUT_POPPLER();
  write(floorplan::plan_of(floorplan::two_rooms()));
  std::istringstream fonts(told_by({"pdffonts", file}));
  std::string line;
  std::getline(fonts, line);
  std::getline(fonts, line);
  std::size_t count = 0;
  for (; std::getline(fonts, line); ++count)
    EXPECT_TRUE(std::regex_search(line, std::regex(" yes yes yes +[0-9]+ +[0-9]+ *$"))) << line;  // embedded, subset
  EXPECT_EQ(count, 2U) << "regular and bold";
  std::istringstream images(told_by({"pdfimages", "-list", file}));
  for (count = 0; std::getline(images, line); ++count) {
  }
  EXPECT_EQ(count, 2U) << "the list's head only";
}

// The page has the SVG's size and places: both are drawn by librsvg, so this is no check of how it draws.
TEST_F(Pdf, LooksAsTheSvgDoes) {
  ATRIUM_SKIP_WITHOUT_POPPLER();
  if (!test::has_program("rsvg-convert")) ATRIUM_SKIP_LACKING("librsvg2-bin is not installed");
  const FloorPlan plan = floorplan::plan_of(floorplan::two_rooms());
  write(plan);
  floorplan::WriteSvg::run({input(plan)}, {}, context);
  told_by({"pdftoppm", "-r", "100", "-gray", file, host->folder / "pdf"});
  told_by({"rsvg-convert", "-d", "100", "-p", "100", "-f", "pdf", host->folder / "floorplan.svg", "-o",
           host->folder / "svg.pdf"});
  told_by({"pdftoppm", "-r", "100", "-gray", host->folder / "svg.pdf", host->folder / "svg"});
  const std::string ours = test::read_text(host->folder / "pdf-1.pgm"),
                    theirs = test::read_text(host->folder / "svg-1.pgm");
  ASSERT_EQ(ours.size(), theirs.size());
  std::size_t other = 0, ink = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const int a = static_cast<unsigned char>(ours[i]), b = static_cast<unsigned char>(theirs[i]);
    if (std::abs(a - b) > 64) ++other;
    if (b < 128) ++ink;
  }
  EXPECT_GT(ink, 5000U);
  EXPECT_LT(other, ink / 50);
}

TEST_F(Pdf, EachStoreyHasAPageOfOneScaleAndSize) {
  ATRIUM_SKIP_WITHOUT_POPPLER();
  floorplan::MeshBuilder b;
  b.room(0, 0, 4, 3);
  b.storey = 1;
  b.room(0, 0, 24, 13, 2.8, 5.3);
  write(floorplan::plan_of(b.mesh));
  const std::string about = info();
  EXPECT_TRUE(std::regex_search(about, std::regex("Pages: +2\n"))) << about;
  std::smatch first, second;
  ASSERT_TRUE(std::regex_search(about, first, std::regex("Page +1 size: +([^\n]*)")));
  ASSERT_TRUE(std::regex_search(about, second, std::regex("Page +2 size: +([^\n]*)")));
  EXPECT_EQ(first[1], second[1]);
  const std::string shown = text();
  for (const char* part : {"Storey 0", "Storey 1", "page 1 of 2", "page 2 of 2"}) EXPECT_TRUE(has(shown, part)) << part;
  std::set<std::string> scales;
  const std::regex scale("1:[0-9]+");
  for (std::sregex_iterator i(shown.begin(), shown.end(), scale), end; i != end; ++i) scales.insert(i->str());
  EXPECT_EQ(scales.size(), 1U) << shown;
  WritePlan::Params params;
  params.storey = 1;
  write(floorplan::plan_of(b.mesh), params);
  EXPECT_TRUE(std::regex_search(info(), std::regex("Pages: +1\n")));
  params.storey = 2;
  EXPECT_THROW(write(floorplan::plan_of(b.mesh), params), Error);
}

TEST_F(Pdf, AllPagesAreAsLargeWhereOneIsLargerThanA0) {
  ATRIUM_SKIP_WITHOUT_POPPLER();
  WritePlan::Params params;
  params.scale = 50;
  for (const Eigen::Vector2d& upper : {Eigen::Vector2d(70, 45), Eigen::Vector2d(75, 5)}) {  // 140 × 90 cm, 150 × 10 cm
    floorplan::MeshBuilder b;
    b.room(0, 0, 30, 20);  // on A1
    b.storey = 1;
    b.room(0, 0, upper.x(), upper.y(), 2.8, 5.3);
    write(floorplan::plan_of(b.mesh), params);
    const std::string about = info();
    std::smatch first, second;
    ASSERT_TRUE(std::regex_search(about, first, std::regex("Page +1 size: +([0-9.]+) x ([0-9.]+) pts"))) << about;
    ASSERT_TRUE(std::regex_search(about, second, std::regex("Page +2 size: +([0-9.]+) x ([0-9.]+) pts"))) << about;
    EXPECT_EQ(first[1], second[1]);
    EXPECT_EQ(first[2], second[2]);
    EXPECT_GT(std::stod(first[1]) / 72 * 0.0254, upper.x() / params.scale);
    const std::string shown = text();
    for (const char* part : {"Storey 0", "Storey 1", " mm"}) EXPECT_TRUE(has(shown, part)) << part << " in " << shown;
  }
}

TEST_F(Pdf, FeetAndInches) {
  ATRIUM_SKIP_WITHOUT_POPPLER();
  WritePlan::Params params;
  params.units = floorplan::Units::feet;
  write(floorplan::plan_of(floorplan::two_rooms()), params);
  const std::string shown = text();
  for (const char* part : {"13\u2032 1\u00BD\u2033", "9\u2032 10\u2033", "0\u2032 4\u00BD\u2033", "129.2 sq ft",
                           "dimensions in feet and inches", "5 ft"})
    EXPECT_TRUE(has(shown, part)) << part << " in " << shown;
}

TEST_F(Pdf, EqualPlansGiveEqualBytes) {
  write(floorplan::plan_of(floorplan::two_rooms()));
  const std::string first = test::read_text(file);
  EXPECT_TRUE(first.starts_with("%PDF-"));
  EXPECT_TRUE(has(first, "D:19700101000000Z"));
  std::filesystem::remove(file);
  write(floorplan::plan_of(floorplan::two_rooms()));
  EXPECT_EQ(test::read_text(file), first);
}

TEST_F(Pdf, NamesOfAllScriptsAreTextOrSaidToBeLacking) {
  FloorPlan plan = floorplan::plan_of(floorplan::two_rooms());
  plan.storeys[0].rooms[0].name = "K\u00FCche <&> \u041A\u0443\u0445\u043D\u044F";  // Küche, Кухня
  plan.storeys[0].rooms[1].name = "\U00012000";                                     // a cuneiform sign
  write(plan);
  if (std::system("fc-list :charset=12000 | grep -q .") == 0)  // NOLINT(concurrency-mt-unsafe): one thread
    GTEST_SKIP() << "this machine has a font for cuneiform";
  ASSERT_EQ(host->warnings.size(), 1U);
  EXPECT_TRUE(has(host->warnings[0], "no installed font has all characters of '\U00012000'")) << host->warnings[0];
  ATRIUM_SKIP_WITHOUT_POPPLER();
  EXPECT_TRUE(has(text(), "K\u00FCche <&> \u041A\u0443\u0445\u043D\u044F"));
}

// In a process of its own, which has not yet asked for fonts.
TEST_F(Pdf, AMachineWithoutFontsIsToldSo) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const std::string none = host->folder / "fonts.conf";
  test::write_text(none, "<fontconfig></fontconfig>");
  const auto draw = [&] {
    setenv("FONTCONFIG_FILE", none.c_str(), 1);  // NOLINT(concurrency-mt-unsafe): this process has one thread
    try {
      write(floorplan::plan_of(floorplan::two_rooms()));
    } catch (const Error& error) {
      fmt::print(stderr, "{}; {}", error.what(), error.help());
      std::_Exit(3);
    }
    std::_Exit(0);
  };
  EXPECT_EXIT(draw(), testing::ExitedWithCode(3),
              "no font is installed; for instance: apt-get install fonts-dejavu-core");
}

TEST_F(Pdf, APlanWithoutStoreysSaysSo) {
  write(FloorPlan{});
  EXPECT_EQ(host->warnings.size(), 1U);
  ATRIUM_SKIP_WITHOUT_POPPLER();
  EXPECT_TRUE(has(text(), "The plan is empty"));
}

TEST_F(Pdf, WhatDoesNotFitLeavesNoFile) {
  WritePlan::Params params;
  params.paper = floorplan::Paper::a4;
  params.scale = 5;
  EXPECT_THROW(write(floorplan::plan_of(floorplan::two_rooms()), params), Error);
  EXPECT_TRUE(std::filesystem::is_empty(host->folder.path()));
}

}  // namespace
}  // namespace atrium::pdf::write_plan_test
