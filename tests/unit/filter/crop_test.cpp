#include "modules/filter/crop.hpp"

#include <gtest/gtest.h>

namespace atrium::filter::crop_test {
namespace {

Cloud cloud() {
  Cloud result;
  result.origin = {500000, 5400000, 0};
  for (int i = 0; i <= 10; ++i) {
    result.points.emplace_back(static_cast<float>(i) * 0.5F, 0, 0);
    result.labels.push_back(i);
  }
  return result;
}

TEST(Crop, TheBoxIsInTrueCoordinatesAndItsFacesBelongToIt) {
  Context context;
  const Crop::Params params{{500001, 5399999, -1}, {500002, 5400001, 1}, Keep::inside};
  const Cloud in = Crop::run({input(cloud())}, params, context).cloud;
  EXPECT_EQ(in.labels, (std::vector<std::int32_t>{2, 3, 4}));
  EXPECT_EQ(in.points.size(), 3U);
  EXPECT_EQ(in.origin, cloud().origin);
}

TEST(Crop, InsideAndOutsideShareThePointsOut) {
  Context context;
  Crop::Params params{{500001, 5399999, -1}, {500002, 5400001, 1}, Keep::outside};
  EXPECT_EQ(Crop::run({input(cloud())}, params, context).cloud.labels,
            (std::vector<std::int32_t>{0, 1, 5, 6, 7, 8, 9, 10}));
  EXPECT_EQ(Crop::run({input(cloud())}, {}, context).cloud.size(), 11U);  // by default the box holds all
}

TEST(Crop, EmptyCloudsAndBoxesOfNegativeWidth) {
  Context context;
  EXPECT_EQ(Crop::run({input(Cloud{})}, {}, context).cloud.size(), 0U);
  EXPECT_THROW(Crop::run({input(cloud())}, {{1, 0, 0}, {0, 1, 1}, Keep::inside}, context), Error);
  EXPECT_EQ(Crop::run({input(cloud())}, {{0, 0, 0}, {1, 1, 1}, Keep::inside}, context).cloud.size(), 0U);
}

}  // namespace
}  // namespace atrium::filter::crop_test
