#include "modules/geometry/exact_sign.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace atrium {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon() / 2;  // 2⁻⁵³

// A sum of doubles that stands for its exact value: parts do not overlap, the greatest comes last, none is zero.
template <std::size_t capacity>
struct Expansion {
  std::array<double, capacity> part;
  std::size_t size = 0;
  void push(double x) {
    if (x != 0) part[size++] = x;
  }
  int sign() const { return size == 0 ? 0 : (part[size - 1] > 0 ? 1 : -1); }
};

struct Pair {
  double high, low;
};
Pair two_sum(double a, double b) {
  const double sum = a + b, b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}
Pair split(double a) {
  const double c = 134217729.0 * a, high = c - (c - a);  // 2²⁷ + 1
  return {high, a - high};
}
Pair two_product(double a, double b) {
  const double product = a * b;
  const auto [ah, al] = split(a);
  const auto [bh, bl] = split(b);
  return {product, al * bl - (((product - ah * bh) - al * bh) - ah * bl)};
}

template <std::size_t n, std::size_t m>
Expansion<n + m> add(const Expansion<n>& a, const Expansion<m>& b) {
  Expansion<n + m> result;
  for (std::size_t i = 0; i < a.size; ++i) result.part[i] = a.part[i];
  result.size = a.size;
  for (std::size_t k = 0; k < b.size; ++k) {  // grow-expansion from the k-th part on
    double q = b.part[k];
    std::size_t kept = 0;
    for (std::size_t i = 0; i < result.size; ++i) {
      const auto [sum, error] = two_sum(q, result.part[i]);
      if (error != 0) result.part[kept++] = error;
      q = sum;
    }
    if (q != 0) result.part[kept++] = q;
    result.size = kept;
  }
  return result;
}
template <std::size_t n>
Expansion<2 * n> scaled(const Expansion<n>& e, double b) {
  Expansion<2 * n> result;
  for (std::size_t i = 0; i < e.size; ++i) {
    const auto [high, low] = two_product(e.part[i], b);
    Expansion<2> product;
    product.push(low);
    product.push(high);
    const auto sum = add(result, product);
    for (std::size_t k = 0; k < sum.size; ++k) result.part[k] = sum.part[k];
    result.size = sum.size;
  }
  return result;
}
template <std::size_t n, std::size_t m>
Expansion<2 * n * m> product(const Expansion<n>& a, const Expansion<m>& b) {
  Expansion<2 * n * m> result;
  for (std::size_t i = 0; i < b.size; ++i) {
    const auto sum = add(result, scaled(a, b.part[i]));
    for (std::size_t k = 0; k < sum.size; ++k) result.part[k] = sum.part[k];
    result.size = sum.size;
  }
  return result;
}
template <std::size_t n>
Expansion<n> negative(Expansion<n> e) {
  for (std::size_t i = 0; i < e.size; ++i) e.part[i] = -e.part[i];
  return e;
}
Expansion<2> difference(double a, double b) {
  const auto [high, low] = two_sum(a, -b);
  Expansion<2> result;
  result.push(low);
  result.push(high);
  return result;
}
// a·d − b·c
Expansion<16> minor(const Expansion<2>& a, const Expansion<2>& b, const Expansion<2>& c, const Expansion<2>& d) {
  return add(product(a, d), negative(product(b, c)));
}

int exact_plane_side(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                     const Eigen::Vector3d& d) {
  std::array<std::array<Expansion<2>, 3>, 3> m;
  for (int k = 0; k < 3; ++k) {
    m[0][k] = difference(a[k], d[k]);
    m[1][k] = difference(b[k], d[k]);
    m[2][k] = difference(c[k], d[k]);
  }
  const auto x = product(minor(m[1][1], m[1][2], m[2][1], m[2][2]), m[0][0]);
  const auto y = product(minor(m[1][2], m[1][0], m[2][2], m[2][0]), m[0][1]);
  const auto z = product(minor(m[1][0], m[1][1], m[2][0], m[2][1]), m[0][2]);
  return -add(add(x, y), z).sign();
}

}  // namespace

int turn_sign(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const double left = (a.x() - c.x()) * (b.y() - c.y()), right = (a.y() - c.y()) * (b.x() - c.x());
  const double det = left - right, bound = (3 + 16 * epsilon) * epsilon * (std::abs(left) + std::abs(right));
  if (det > bound) return 1;
  if (-det > bound) return -1;
  if (bound == 0) return 0;
  return minor(difference(a.x(), c.x()), difference(a.y(), c.y()), difference(b.x(), c.x()), difference(b.y(), c.y()))
      .sign();
}

int plane_side(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d) {
  const Eigen::Vector3d ad = a - d, bd = b - d, cd = c - d;
  double det = 0, permanent = 0;
  for (int i = 0; i < 3; ++i) {
    const int k = (i + 1) % 3, l = (i + 2) % 3;
    const double plus = bd[k] * cd[l], minus = bd[l] * cd[k];
    det += ad[i] * (plus - minus);
    permanent += std::abs(ad[i]) * (std::abs(plus) + std::abs(minus));
  }
  // Shewchuk's bound, and a little more: terms may be summed in another order here.
  const double bound = (10 + 64 * epsilon) * epsilon * permanent;
  if (det > bound) return -1;
  if (-det > bound) return 1;
  if (permanent == 0) return 0;
  return exact_plane_side(a, b, c, d);
}

}  // namespace atrium
