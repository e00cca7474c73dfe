#include "modules/plane/none.hpp"

#include <gtest/gtest.h>

namespace atrium::plane::none_test {
namespace {

TEST(PlaneNone, HandsItsInputOnWithoutACopy) {
  Context context;
  const auto planes = input(PlanePrimitives{});
  EXPECT_EQ(None::run({planes}).planes, planes);
}

}  // namespace
}  // namespace atrium::plane::none_test
