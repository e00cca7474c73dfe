#include "modules/floorplan/units.hpp"

#include <gtest/gtest.h>

namespace atrium::floorplan::units_test {
namespace {

TEST(Units, LengthsAreWrittenAsPlansHaveThem) {
  EXPECT_EQ(dimension_text(3.4549, Units::metres), "3.45");
  EXPECT_EQ(length_text(3.4549, Units::metres), "3.45 m");
  EXPECT_EQ(length_text(-0.004, Units::metres), "0.00 m");
  EXPECT_EQ(dimension_text(3.4549, Units::millimetres), "3455");
  EXPECT_EQ(length_text(-0.5, Units::millimetres), "-500 mm");
  EXPECT_EQ(area_text(12.345, Units::metres), "12.35 m\u00B2");
  EXPECT_EQ(area_text(12.345, Units::millimetres), "12.35 m\u00B2");
  EXPECT_EQ(area_text(10, Units::feet), "107.6 sq ft");
}

TEST(Units, FeetAndInchesGoToTheHalfInch) {
  const double inch = 0.0254;
  struct Case {
    double inches;
    std::string text, plain;
  };
  for (const auto& [inches, text, plain] :
       std::vector<Case>{{147.5, "12\u2032 3\u00BD\u2033", "12'-3 1/2\""},
                         {147.24, "12\u2032 3\u2033", "12'-3\""},
                         {147.26, "12\u2032 3\u00BD\u2033", "12'-3 1/2\""},
                         {143.8, "12\u2032 0\u2033", "12'-0\""},  // carried over twice
                         {12.4, "1\u2032 \u00BD\u2033", "1'-0 1/2\""},
                         {4.5, "0\u2032 4\u00BD\u2033", "0'-4 1/2\""},
                         {0.1, "0\u2032 0\u2033", "0'-0\""},
                         {-0.1, "0\u2032 0\u2033", "0'-0\""},
                         {-19.5, "-1\u2032 7\u00BD\u2033", "-1'-7 1/2\""}}) {
    EXPECT_EQ(dimension_text(inches * inch, Units::feet), text) << inches;
    EXPECT_EQ(length_text(inches * inch, Units::feet, true), plain) << inches;
  }
}

}  // namespace
}  // namespace atrium::floorplan::units_test
