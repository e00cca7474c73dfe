#include "modules/align/none.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace atrium::align::none_test {
namespace {

TEST(AlignNone, HandsItsInputOnWithoutACopy) {
  Context context;
  const auto planes = input(PlanePrimitives{});
  Transform turned;
  turned.rotation = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const auto out = None::run({planes, input(turned)});
  EXPECT_EQ(out.planes, planes);
  EXPECT_EQ(out.transform.rotation, turned.rotation);
  EXPECT_EQ(None::run({planes, {}}).transform.rotation, Eigen::Matrix3d::Identity());
}

}  // namespace
}  // namespace atrium::align::none_test
