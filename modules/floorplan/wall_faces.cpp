#include "modules/floorplan/wall_faces.hpp"

#include <algorithm>
#include <limits>

namespace atrium::floorplan {
namespace {

constexpr double hairline = 0.005;  // metres: pieces of one face nearer than this are one
constexpr double inside = 0.01;     // metres below the top of a wall that does not reach to the section

Span heights_of(const Surface& s) {
  Span range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const auto& triangle : s.triangles)
    for (const auto& p : triangle) range = {std::min(range.from, p.z()), std::max(range.to, p.z())};
  return range;
}

// Where the plane at `height` cuts the triangle: a span along the face's line, or nothing.
bool cut(const std::array<Eigen::Vector3d, 3>& triangle, double height, const WallFace& face, Span& span) {
  span = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d &a = triangle[k], &b = triangle[(k + 1) % 3];
    if ((a.z() < height) == (b.z() < height)) continue;
    const double share = (height - a.z()) / (b.z() - a.z());
    const double s = face.coordinate((a + share * (b - a)).head<2>());
    span = {std::min(span.from, s), std::max(span.to, s)};
  }
  return span.length() > 0;
}

}  // namespace

std::vector<Span> merged(std::vector<Span> spans, double gap) {
  std::sort(spans.begin(), spans.end(),
            [](const Span& a, const Span& b) { return a.from != b.from ? a.from < b.from : a.to < b.to; });
  std::vector<Span> result;
  for (const auto& span : spans) {
    if (!result.empty() && span.from <= result.back().to + gap)
      result.back().to = std::max(result.back().to, span.to);
    else
      result.push_back(span);
  }
  return result;
}

std::vector<Span> without(const std::vector<Span>& spans, const Span& hole) {
  std::vector<Span> result;
  for (const auto& span : spans) {
    if (const Span left{span.from, std::min(span.to, hole.from)}; left.length() > 0) result.push_back(left);
    if (const Span right{std::max(span.from, hole.to), span.to}; right.length() > 0) result.push_back(right);
  }
  return hole.length() > 0 ? result : spans;
}

std::vector<Span> overlap(const std::vector<Span>& spans, const Span& window) {
  std::vector<Span> result;
  for (const auto& span : spans)
    if (const Span both{std::max(span.from, window.from), std::min(span.to, window.to)}; both.length() > 0)
      result.push_back(both);
  return result;
}

std::vector<WallFace> wall_faces(const std::vector<Surface>& surfaces, double height) {
  std::vector<WallFace> faces;
  for (const auto& s : surfaces) {
    const double level = s.normal.head<2>().norm();
    if (s.surface != SurfaceClass::wall || level < 0.1) continue;  // steeper than 6° from a floor
    const Span range = heights_of(s);
    const double lowest = std::min(range.from + inside, 0.5 * (range.from + range.to));
    const double highest = std::max(range.to - inside, 0.5 * (range.from + range.to));
    const double at = std::clamp(height, lowest, highest);
    WallFace face;
    face.primitive = s.primitive;
    face.normal = s.normal.head<2>() / level;
    // The foot of the plane's line at that height.
    face.point = s.centre.head<2>() - face.normal * (s.normal.z() * (at - s.centre.z()) / level);
    for (const auto& triangle : s.triangles)
      if (Span span; cut(triangle, at, face, span)) face.spans.push_back(span);
    face.spans = merged(std::move(face.spans), hairline);
    if (!face.spans.empty()) faces.push_back(std::move(face));
  }
  return faces;
}

}  // namespace atrium::floorplan
