// SVG files in the hands of programs of others: xmllint reads them, rsvg-convert draws them.
#include <gtest/gtest.h>

#include "modules/floorplan/write_svg.hpp"
#include "tests/support/svg_drawing.hpp"
#include "tests/unit/floorplan/buildings.hpp"

namespace atrium::floorplan::draw_svg_test {
namespace {

class DrawnSvg : public testing::Test {
 protected:
  std::shared_ptr<Host> host = std::make_shared<Host>();
  Context context{1, host};

  void SetUp() override { ATRIUM_SKIP_WITHOUT_SVG_READERS(); }
  test::SvgDrawing draw(const FloorPlan& plan, const WriteSvg::Params& params = {}, int scale = 96) {
    WriteSvg::run({input(plan)}, params, context);
    return test::drawn(host->folder / "floorplan.svg", scale);
  }
};

TEST_F(DrawnSvg, WallsAreTrueToScale) {
  WriteSvg::Params params;
  params.scale = 50;
  params.paper = Paper::a4;
  const auto drawing = draw(plan_of(two_rooms()), params, 254);  // 10 dots a millimetre
  EXPECT_EQ(drawing.width, 2970U);
  EXPECT_EQ(drawing.height, 2100U);
  // The wall of 12 cm × 3 m is 24 × 600 dots large, and its outline covers 1.75 dots along each edge.
  EXPECT_GE(drawing.count(0x33363B), 19U * 595U);
  EXPECT_LE(drawing.count(0x33363B), 21U * 597U);
}

TEST_F(DrawnSvg, EveryKindOfPlanIsReadWithoutComplaint) {
  Mesh far = two_rooms();
  far.origin = {500000.123, 5400000.456, 300};
  MeshBuilder only_ceiling, only_wall;
  only_ceiling.ceiling(0, 0, 5, 4, 2.6);
  only_wall.wall(0, 0, 4, 0);
  FloorPlan doubtful = with_openings();
  doubtful.storeys[0].rooms[0].confidence = 0.37;
  for (auto& wall : doubtful.storeys[0].walls) wall.inferred = true;
  const std::vector<std::pair<std::string, FloorPlan>> plans{{"openings", with_openings()},
                                                             {"far away", plan_of(far)},
                                                             {"only a ceiling", plan_of(only_ceiling.mesh)},
                                                             {"only a wall", plan_of(only_wall.mesh)},
                                                             {"doubtful", doubtful},
                                                             {"a row of rooms", plan_of(row_of_rooms(3, 4, 30))},
                                                             {"a tower", tower(16)}};
  for (const auto& [name, plan] : plans) EXPECT_GT(draw(plan).ink(), 0.01) << name;
  EXPECT_GT(draw({}).ink(), 0.002) << "the frame and what is said of an empty plan";
}

TEST_F(DrawnSvg, AnyTextIsReadWithoutComplaint) {
  FloorPlan plan = plan_of(two_rooms());
  plan.storeys[0].rooms[0].name = "]]> <svg> & \"\u53A8\u623F\" \U0001F373";
  WriteSvg::Params params;
  for (const std::string& title :
       {std::string("<b> & \"quoted\" \x01 \xC3\xBC \xFF"), std::string("a\0b", 3),
        std::string("\xED\xA0\x80 \xE2\x82"), std::string("\uFFFE \uFFFF \u0085 \x7F"), std::string(500, 'W')}) {
    params.title = title;
    EXPECT_GT(draw(plan, params).ink(), 0.01) << title;
  }
}

// What the checks above are worth: of each of these one of the two programs has a complaint.
TEST_F(DrawnSvg, FilesThatAreDamagedAreFound) {
  WriteSvg::run({input(with_openings())}, {}, context);
  const std::string sound = test::read_text(host->folder / "floorplan.svg");
  const auto file = host->folder / "damaged.svg";
  const std::string start = sound.substr(0, sound.find('>', sound.find("<svg")) + 1);
  for (const std::string& text :
       {sound.substr(0, sound.size() / 2), sound + "<g/>", start + "<text>a & b</text></svg>", std::string(),
        start + "<text>\x01</text></svg>", start + "<text>\xFF</text></svg>", start + "<g></svg>"}) {
    test::write_text(file, text);
    EXPECT_NE(test::run_process({"xmllint", "--noout", file.string()}).err, "") << text.substr(0, 300);
  }
  test::write_text(file, start + "</svg>");
  EXPECT_EQ(test::drawn(file).ink(), 0) << "nothing is drawn";
}

}  // namespace
}  // namespace atrium::floorplan::draw_svg_test
