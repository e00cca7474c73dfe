// The sheet that plans stand on: its size, its scale, its titles, and where each storey is.
#include <cmath>

#include "modules/floorplan/fitted_text.hpp"
#include "modules/floorplan/svg_canvas.hpp"
#include "tests/unit/floorplan/svg.hpp"

namespace atrium::floorplan::svg_sheet_test {
namespace {

// Drawings with their captions keep clear of each other, of the frame and of the title block.
void expect_drawings_apart(const Sheet& sheet, const FloorPlan& plan) {
  std::vector<Bounds2> boxes;
  for (std::size_t i = 0; i < plan.storeys.size(); ++i) {
    const PlanStorey& storey = plan.storeys[i];
    const Bounds2 drawing = drawing_bounds(storey, 1 / sheet.per_metre());
    const Eigen::Vector2d caption = sheet.on_paper(i, {bounds(storey).low.x(), drawing.high.y()});
    Bounds2 box;
    box.add(sheet.on_paper(i, drawing.low));
    box.add(sheet.on_paper(i, drawing.high));
    box.add(caption);
    box.add(caption + Eigen::Vector2d(sheet.captions[i].width(), -sheet.captions[i].height()));
    EXPECT_GE(box.low.minCoeff(), frame_margin) << i;
    EXPECT_LE(box.high.x(), sheet.size.x() - frame_margin) << i;
    EXPECT_LE(box.high.y(), sheet.size.y() - frame_margin - title_height) << i;
    for (std::size_t k = 0; k < boxes.size(); ++k)
      EXPECT_TRUE((box.low.array() >= boxes[k].high.array()).any() || (boxes[k].low.array() >= box.high.array()).any())
          << i << " and " << k;
    boxes.push_back(box);
  }
}

TEST_F(Svg, ThePaperGrowsBeforeTheScaleShrinks) {
  const auto sheet = [](double width, double height, Paper paper = Paper::automatic, int scale = 0) {
    return arranged(plan_of(row_of_rooms(width, height, 1)).storeys, 0, paper, scale);
  };
  EXPECT_EQ(sheet(3, 3).paper, "A4");
  EXPECT_EQ(sheet(3, 3).scale, 50);
  EXPECT_EQ(sheet(12, 8).paper, "A3");
  EXPECT_EQ(sheet(12, 8).scale, 50);
  EXPECT_EQ(sheet(30, 15).scale, 100);
  EXPECT_EQ(sheet(200, 100).scale, 1000);
  EXPECT_EQ(sheet(30, 15, Paper::automatic, 50).paper, "A1");
  EXPECT_EQ(sheet(12, 8, Paper::a4).scale, 100);
  EXPECT_GT(sheet(3, 12, Paper::a3).size.y(), sheet(3, 12, Paper::a3).size.x());  // upright
}

TEST_F(Svg, StoreysStandOnOneSheetOrAlone) {
  MeshBuilder b;
  b.room(0, 0, 4, 3);
  b.storey = 1;
  b.room(0, 0, 4, 3, 2.8, 5.3);
  const FloorPlan plan = plan_of(b.mesh);
  const std::string both = write(plan);
  EXPECT_TRUE(has_text(both, "Storey 0"));
  EXPECT_TRUE(has_text(both, "Storey 1"));
  WriteSvg::Params params;
  params.storey = 1;
  const std::string one = write(plan, params);
  EXPECT_FALSE(has_text(one, "Storey 0"));
  EXPECT_TRUE(has_text(one, "Room 2"));
  std::filesystem::remove(file);
  params.storey = 2;
  EXPECT_EQ(error_of(plan, params), "the plan has no storey 2");
}

TEST_F(Svg, WhatDoesNotFitIsAnErrorThatSaysWhatWouldDo) {
  const auto help_of = [&](const FloorPlan& plan, Paper paper, int scale) -> std::string {
    WriteSvg::Params params;
    params.paper = paper;
    params.scale = scale;
    try {
      write(plan, params);
    } catch (const Error& error) {
      return error.help();
    }
    return {};
  };
  WriteSvg::Params params;
  params.paper = Paper::a4;
  params.scale = 50;
  EXPECT_EQ(error_of(plan_of(row_of_rooms(30, 20, 1)), params), "the plan does not fit on A4 at 1:50");
  EXPECT_TRUE(help_of(plan_of(row_of_rooms(30, 20, 1)), Paper::a4, 50).starts_with("A1 has room for it at 1:50;"));
  EXPECT_TRUE(help_of(plan_of(row_of_rooms(100, 60, 1)), Paper::a0, 50).starts_with("it takes 20"));
  EXPECT_EQ(help_of(tower(60), Paper::a4, 0).substr(0, 22), "A2 has room for it at ");
}

TEST_F(Svg, ATowerOfAnyHeightHasPaperLargeEnough) {
  for (const int storeys : {1, 2, 3, 8, 16, 20, 60}) {
    const FloorPlan plan = tower(storeys);
    const Sheet sheet = arranged(plan.storeys, 0, Paper::automatic, 0);
    EXPECT_GE(5 * sheet.per_metre(), 25) << storeys;
    expect_drawings_apart(sheet, plan);
  }
  const FloorPlan plan = tower(100);
  const Sheet custom = arranged(plan.storeys, 0, Paper::automatic, 10);
  EXPECT_GT(custom.size.x(), 1189);
  EXPECT_EQ(custom.paper, fmt::format("{} \u00D7 {} mm", custom.size.x(), custom.size.y()));
  expect_drawings_apart(custom, plan);
  EXPECT_TRUE(has_text(write(tower(16)), "Storey 15"));
}

TEST_F(Svg, TheLowestStoreyIsAtTheLeftAndAtTheBottom) {
  const FloorPlan plan = tower(16);
  const Sheet sheet = arranged(plan.storeys, 0, Paper::automatic, 0);
  for (std::size_t i = 1; i < sheet.places.size(); ++i) {
    const Eigen::Vector2d step = sheet.places[i] - sheet.places[i - 1];
    EXPECT_TRUE(step.y() < -1 || (std::abs(step.y()) < 1e-6 && step.x() > 1)) << i;
  }
}

TEST_F(Svg, LongTitlesKeepToTheirPlace) {
  for (const auto* text :
       {"A title that is much, much longer than the strip of the title block has any room for, even if it is set as "
        "small as anyone can still read it",
        "WWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWW",
        "\u5E73\u9762\u56F3\u5E73\u9762\u56F3\u5E73\u9762\u56F3\u5E73\u9762\u56F3\u5E73\u9762\u56F3\u5E73\u9762\u56F3"
        "\u5E73\u9762\u56F3\u5E73\u9762\u56F3\u5E73\u9762\u56F3\u5E73\u9762\u56F3"
        "\u5E73\u9762\u56F3\u5E73\u9762\u56F3\u5E73\u9762\u56F3\u5E73\u9762\u56F3\u5E73\u9762\u56F3\u5E73\u9762\u56F3"
        "\u5E73\u9762\u56F3\u5E73\u9762\u56F3\u5E73\u9762\u56F3\u5E73\u9762\u56F3"}) {
    WriteSvg::Params params;
    params.title = text;
    params.paper = Paper::a4;
    const ptree root = parsed(write(plan_of(two_rooms()), params));
    const double paper_width = std::stod(root.get<std::string>("<xmlattr>.width"));
    bool found = false;
    each(root, "text", [&](const ptree& element) {
      if (!element.data().ends_with("\u2026")) return;
      found = true;
      const double right = element.get<double>("<xmlattr>.x") +
                           font_width(element.data(), element.get<double>("<xmlattr>.font-size"), true);
      EXPECT_LE(right, paper_width - 100);  // where the scale begins
      EXPECT_GT(element.data().size(), 20U);
      EXPECT_TRUE(std::string(text).starts_with(element.data().substr(0, element.data().size() - 3)));
    });
    EXPECT_TRUE(found) << text;
  }
  EXPECT_EQ(fitted("Short", 100, 5, 3).size, 5);
  const FittedText smaller = fitted("Not quite so short", 40, 5, 3);
  EXPECT_EQ(smaller.text, "Not quite so short");
  EXPECT_NEAR(font_width(smaller.text, smaller.size), 40, 1e-9);
  EXPECT_EQ(fitted("abc", 1, 5, 3).text, "\u2026");
}

}  // namespace
}  // namespace atrium::floorplan::svg_sheet_test
