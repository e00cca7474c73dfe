#include "modules/filter/none.hpp"

#include <gtest/gtest.h>

namespace atrium::filter::none_test {
namespace {

TEST(FilterNone, HandsItsInputOnWithoutACopy) {
  Context context;
  const auto cloud = input(Cloud{});
  EXPECT_EQ(None::run({cloud}).cloud, cloud);
}

}  // namespace
}  // namespace atrium::filter::none_test
