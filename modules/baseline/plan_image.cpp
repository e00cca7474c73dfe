#include "modules/baseline/plan_image.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace atrium::baseline {
namespace {

// Along one axis: whether any (all) of the squares within `radius` are not 0.
PlanImage spread(const PlanImage& image, int radius, int dx, int dy, bool all) {
  PlanImage result = image;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      int count = 0;
      for (int k = -radius; k <= radius; ++k) count += image.at(x + k * dx, y + k * dy) != 0 ? 1 : 0;
      result.at(x, y) = (all ? count == 2 * radius + 1 : count > 0) ? 1 : 0;
    }
  return result;
}

using Corner = std::pair<int, int>;
constexpr std::array<Corner, 4> steps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};  // counter-clockwise

// The sides of the squares with the squares on the left: direction(s) that leave each corner.
std::map<Corner, std::vector<int>> sides_of(const PlanImage& image, std::int32_t value) {
  std::map<Corner, std::vector<int>> sides;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      if (image.at(x, y) != value) continue;
      if (image.at(x, y - 1) != value) sides[{x, y}].push_back(0);
      if (image.at(x + 1, y) != value) sides[{x + 1, y}].push_back(1);
      if (image.at(x, y + 1) != value) sides[{x + 1, y + 1}].push_back(2);
      if (image.at(x - 1, y) != value) sides[{x, y + 1}].push_back(3);
    }
  return sides;
}

double area_of(const PlanRing& ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const auto &a = ring[i], &b = ring[(i + 1) % ring.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

}  // namespace

PlanImage dilated(const PlanImage& image, int radius) {
  return spread(spread(image, radius, 1, 0, false), radius, 0, 1, false);
}
PlanImage eroded(const PlanImage& image, int radius) {
  return spread(spread(image, radius, 1, 0, true), radius, 0, 1, true);
}

PlanImage components(const PlanImage& image, std::vector<std::size_t>& sizes) {
  PlanImage result(image.low, image.pixel, image.width, image.height);
  sizes.clear();
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      if (image.at(x, y) == 0 || result.at(x, y) != 0) continue;
      const auto number = static_cast<std::int32_t>(sizes.size() + 1);
      std::vector<Corner> members{{x, y}};
      result.at(x, y) = number;
      for (std::size_t i = 0; i < members.size(); ++i)
        for (const auto& [dx, dy] : steps) {
          const int nx = members[i].first + dx, ny = members[i].second + dy;
          if (!image.holds(nx, ny) || image.at(nx, ny) != image.at(x, y) || result.at(nx, ny) != 0) continue;
          result.at(nx, ny) = number;
          members.emplace_back(nx, ny);
        }
      sizes.push_back(members.size());
    }
  return result;
}

std::vector<int> extents_of(const PlanImage& components, std::size_t count) {
  std::vector<Eigen::AlignedBox2i> boxes(count);
  for (int y = 0; y < components.height; ++y)
    for (int x = 0; x < components.width; ++x)
      if (const auto k = components.at(x, y); k > 0)
        boxes[static_cast<std::size_t>(k - 1)].extend(Eigen::Vector2i(x, y));
  std::vector<int> extents;
  extents.reserve(count);
  for (const auto& box : boxes) extents.push_back(box.isEmpty() ? 0 : box.sizes().maxCoeff() + 1);
  return extents;
}

void fill_holes(PlanImage& image, std::size_t most) {
  PlanImage gaps = image;
  for (auto& v : gaps.values) v = v == 0 ? 1 : 0;
  std::vector<std::size_t> sizes;
  const PlanImage numbered = components(gaps, sizes);
  std::vector<char> open(sizes.size() + 1, 0);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (x == 0 || y == 0 || x + 1 == image.width || y + 1 == image.height)
        open[static_cast<std::size_t>(numbered.at(x, y))] = 1;
  for (std::size_t i = 0; i < image.values.size(); ++i)
    if (const auto k = static_cast<std::size_t>(numbered.values[i]); k > 0 && !open[k] && sizes[k - 1] <= most)
      image.values[i] = 1;
}

PlanPolygon border_of(const PlanImage& image, std::int32_t value) {
  auto sides = sides_of(image, value);
  PlanPolygon polygon;
  while (!sides.empty()) {
    PlanRing ring;
    Corner corner = sides.begin()->first;
    int direction = sides.begin()->second.front();
    while (true) {
      const auto place = sides.find(corner);
      if (place == sides.end()) break;
      auto& out = place->second;
      // Where two squares touch at a corner only, turn left: the ring stays with its square.
      auto taken = std::find(out.begin(), out.end(), out.size() > 1 ? (direction + 1) % 4 : out.front());
      if (taken == out.end()) taken = out.begin();
      direction = *taken;
      out.erase(taken);
      if (out.empty()) sides.erase(place);
      ring.emplace_back(image.low + image.pixel * Eigen::Vector2d(corner.first, corner.second));
      corner.first += steps[static_cast<std::size_t>(direction)].first;
      corner.second += steps[static_cast<std::size_t>(direction)].second;
    }
    if (area_of(ring) > 0)
      polygon.outline = std::move(ring);
    else
      polygon.holes.push_back(std::move(ring));
  }
  return polygon;
}

}  // namespace atrium::baseline
