#pragma once
#include <cstddef>
#include <vector>

namespace atrium::metric {

/// The corners of a ring at which it turns: those within 1 mm of the line through their neighbours are left out, one
/// after the other, down to three. `Place` is a vector of two or three doubles.
template <class Place>
std::vector<Place> corners_of(std::vector<Place> ring) {
  constexpr double straight = 0.001;
  const auto from_line = [](const Place& p, const Place& a, const Place& b) {
    const Place along = b - a, to = p - a;
    const double length = along.norm();
    return length > 0 ? (to - along * (along.dot(to) / (length * length))).norm() : to.norm();
  };
  for (std::size_t i = 0; i < ring.size() && ring.size() > 3;) {
    const std::size_t n = ring.size();
    if (from_line(ring[i], ring[(i + n - 1) % n], ring[(i + 1) % n]) <= straight) {
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
      i = i > 0 ? i - 1 : 0;
    } else {
      ++i;
    }
  }
  return ring;
}

}  // namespace atrium::metric
