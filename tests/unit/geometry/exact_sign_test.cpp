#include "modules/geometry/exact_sign.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

#include "graph/api/random.hpp"

namespace atrium::exact_sign_test {
namespace {

using V2 = Eigen::Vector2d;
using V3 = Eigen::Vector3d;
using Exact = boost::multiprecision::cpp_rational;

int exact_turn(const V2& a, const V2& b, const V2& c) {
  const Exact det = (Exact(a.x()) - Exact(c.x())) * (Exact(b.y()) - Exact(c.y())) -
                    (Exact(a.y()) - Exact(c.y())) * (Exact(b.x()) - Exact(c.x()));
  return det.sign();
}
int exact_side(const V3& a, const V3& b, const V3& c, const V3& d) {
  std::array<std::array<Exact, 3>, 3> m;
  for (int k = 0; k < 3; ++k) {
    m[0][k] = Exact(a[k]) - Exact(d[k]);
    m[1][k] = Exact(b[k]) - Exact(d[k]);
    m[2][k] = Exact(c[k]) - Exact(d[k]);
  }
  Exact det = 0;
  for (int k = 0; k < 3; ++k)
    det += m[0][k] * (m[1][(k + 1) % 3] * m[2][(k + 2) % 3] - m[1][(k + 2) % 3] * m[2][(k + 1) % 3]);
  return -det.sign();
}

TEST(ExactSign, PlainCases) {
  EXPECT_EQ(turn_sign({0, 0}, {1, 0}, {0, 1}), 1);
  EXPECT_EQ(turn_sign({0, 0}, {0, 1}, {1, 0}), -1);
  EXPECT_EQ(turn_sign({0.1, 0.1}, {0.1, 0.1}, {3, 4}), 0);
  EXPECT_EQ(plane_side({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, 1}), 1);
  EXPECT_EQ(plane_side({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, -1e-300}), -1);
  EXPECT_EQ(plane_side({0, 0, 7}, {1, 0, 7}, {0, 1, 7}, {1e9, -3, 7}), 0);
}

TEST(ExactSign, AgreesWithRationalArithmeticWhereRoundingHides) {
  Random random(5);
  int zeros = 0, differ = 0;
  for (int i = 0; i < 20000; ++i) {
    // Nearly in one plane: combinations of three corners, rounded, some nudged by one unit in the last place.
    const auto any = [&] { return V3(random.uniform(-10, 10), random.uniform(-10, 10), random.uniform(-10, 10)); };
    V3 a = any(), b = any(), c = any();
    if (i % 3 == 0)  // on a coarse raster, where exact zeros are common
      for (V3* p : {&a, &b, &c}) *p = (*p * 4).array().round() / 4;
    V3 d = a + 0.25 * (b - a) + 0.5 * (c - a);
    if (i % 5 == 0 && d.z() != 0) d.z() = std::nextafter(d.z(), 100);  // beside 0 products underflow
    const int side = plane_side(a, b, c, d);
    ASSERT_EQ(side, exact_side(a, b, c, d));
    zeros += side == 0 ? 1 : 0;
    const double naive = -(a - d).dot((b - d).cross(c - d));
    differ += (naive > 0) - (naive < 0) != side ? 1 : 0;
    const V2 p = a.head<2>(), q = b.head<2>(), r = p + 0.5 * (q - p);
    ASSERT_EQ(turn_sign(p, q, r), exact_turn(p, q, r));
  }
  EXPECT_GT(zeros, 1000);
  EXPECT_GT(differ, 1000) << "the cases are too easy: rounded arithmetic would do";
}

TEST(ExactSign, ChangesWithThePermutation) {
  Random random(6);
  for (int i = 0; i < 1000; ++i) {
    const auto any = [&] { return V3(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)); };
    const V3 a = any(), b = any(), c = any(), d = a + b - c;
    const int side = plane_side(a, b, c, d);
    EXPECT_EQ(plane_side(b, c, a, d), side);
    EXPECT_EQ(plane_side(b, a, c, d), -side);
    EXPECT_EQ(plane_side(a, b, d, c), -side);
  }
}

}  // namespace
}  // namespace atrium::exact_sign_test
