#include "modules/building/profile.hpp"

#include <algorithm>
#include <cmath>

namespace atrium::building {
namespace {

constexpr double same_place = 1e-6;  // metres
constexpr double small_step = 0.01;  // metres

double between(double from, double to, double a, double b, double at) {
  return to - from > 0 ? a + (b - a) * (at - from) / (to - from) : a;
}
double low_at(const ProfilePart& part, double s) { return between(part.from, part.to, part.low_from, part.low_to, s); }
double high_at(const ProfilePart& part, double s) {
  return between(part.from, part.to, part.high_from, part.high_to, s);
}

std::vector<double> distinct(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  std::vector<double> result;
  for (const double v : values)
    if (result.empty() || v - result.back() > same_place) result.push_back(v);
  return result;
}

using Profiles = std::vector<std::vector<ProfilePart>>;

/// All places where a part begins or ends, or where the feet or heads of two of them cross.
std::vector<double> stops_of(const Profiles& profiles, double length) {
  std::vector<double> stops{0, length};
  std::vector<const ProfilePart*> parts;
  for (const auto& profile : profiles)
    for (const auto& part : profile) {
      parts.push_back(&part);
      for (const double s : {part.from, part.to})
        if (s > 0 && s < length) stops.push_back(s);
    }
  const auto add_crossing = [&](double from, double to, double first, double last) {
    if (first * last >= 0) return;
    const double s = from + (to - from) * first / (first - last);
    if (s > 0 && s < length) stops.push_back(s);
  };
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t k = i + 1; k < parts.size(); ++k) {
      const double from = std::max(parts[i]->from, parts[k]->from), to = std::min(parts[i]->to, parts[k]->to);
      if (to - from <= same_place) continue;
      add_crossing(from, to, high_at(*parts[i], from) - high_at(*parts[k], from),
                   high_at(*parts[i], to) - high_at(*parts[k], to));
      add_crossing(from, to, low_at(*parts[i], from) - low_at(*parts[k], from),
                   low_at(*parts[i], to) - low_at(*parts[k], to));
    }
  return distinct(std::move(stops));
}

bool goes_on(double from, double middle, double to, double a, double b, double c) {
  return std::abs(between(from, to, a, c, middle) - b) < same_place;
}

/// Parts that go on straight are one.
std::vector<ProfilePart> straightened(const std::vector<ProfilePart>& parts) {
  std::vector<ProfilePart> result;
  for (const auto& part : parts) {
    if (!result.empty()) {
      ProfilePart& last = result.back();
      if (std::abs(last.low_to - part.low_from) < same_place && std::abs(last.high_to - part.high_from) < same_place &&
          goes_on(last.from, last.to, part.to, last.low_from, last.low_to, part.low_to) &&
          goes_on(last.from, last.to, part.to, last.high_from, last.high_to, part.high_to)) {
        last.to = part.to;
        last.low_to = part.low_to;
        last.high_to = part.high_to;
        continue;
      }
    }
    result.push_back(part);
  }
  return result;
}

/// Heights that differ by no more than a small step are that of the longest part.
void level_out(std::vector<ProfilePart>& parts, double ProfilePart::*first, double ProfilePart::*second) {
  double least = 1e300, most = -1e300, longest = -1, height = 0;
  for (const auto& part : parts) {
    least = std::min({least, part.*first, part.*second});
    most = std::max({most, part.*first, part.*second});
    if (part.to - part.from > longest) {
      longest = part.to - part.from;
      height = part.*first;
    }
  }
  if (most - least > small_step) return;
  for (auto& part : parts) part.*first = part.*second = height;
}

}  // namespace

bool ProfilePart::level() const { return low_from == low_to && high_from == high_to; }

std::vector<ProfilePart> profile_of(const Building& building, const BuildingFace& face, const Eigen::Vector2d& start,
                                    const Eigen::Vector2d& along) {
  std::vector<Eigen::Vector2d> ring;
  std::vector<double> stops;
  for (const auto v : face.outline) {
    const Eigen::Vector3d& p = building.vertices[v];
    ring.emplace_back(along.dot(p.head<2>() - start), p.z());
    stops.push_back(ring.back().x());
  }
  stops = distinct(std::move(stops));
  std::vector<ProfilePart> result;
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    const double middle = 0.5 * (stops[i] + stops[i + 1]);
    double low = 1e300, high = -1e300;
    ProfilePart part{stops[i], stops[i + 1]};
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Eigen::Vector2d &a = ring[k], &b = ring[(k + 1) % ring.size()];
      if ((a.x() > middle) == (b.x() > middle)) continue;
      const auto at = [&](double s) { return a.y() + (b.y() - a.y()) * (s - a.x()) / (b.x() - a.x()); };
      if (at(middle) < low) {
        low = at(middle);
        part.low_from = at(part.from);
        part.low_to = at(part.to);
      }
      if (at(middle) > high) {
        high = at(middle);
        part.high_from = at(part.from);
        part.high_to = at(part.to);
      }
    }
    if (high > low) result.push_back(part);
  }
  return straightened(result);
}

std::vector<ProfilePart> joined_profile(const Profiles& profiles, double length) {
  const std::vector<double> stops = stops_of(profiles, length);
  std::vector<ProfilePart> result;
  std::vector<bool> known;
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    ProfilePart part{stops[i], stops[i + 1], 1e300, 1e300, -1e300, -1e300};
    const double middle = 0.5 * (part.from + part.to);
    for (const auto& profile : profiles)
      for (const auto& one : profile) {
        if (one.from > middle || one.to < middle) continue;
        part.low_from = std::min(part.low_from, low_at(one, part.from));
        part.low_to = std::min(part.low_to, low_at(one, part.to));
        part.high_from = std::max(part.high_from, high_at(one, part.from));
        part.high_to = std::max(part.high_to, high_at(one, part.to));
      }
    known.push_back(part.high_from > -1e300);
    result.push_back(part);
  }
  const auto fill = [&](std::size_t i, double low, double high) {
    result[i].low_from = result[i].low_to = low;
    result[i].high_from = result[i].high_to = high;
    known[i] = true;
  };
  for (std::size_t i = 1; i < result.size(); ++i)
    if (!known[i] && known[i - 1]) fill(i, result[i - 1].low_to, result[i - 1].high_to);
  for (std::size_t i = result.size(); i-- > 1;)
    if (known[i] && !known[i - 1]) fill(i - 1, result[i].low_from, result[i].high_from);
  if (result.empty() || !known.front()) return {};
  level_out(result, &ProfilePart::low_from, &ProfilePart::low_to);
  level_out(result, &ProfilePart::high_from, &ProfilePart::high_to);
  return straightened(result);
}

std::vector<ProfilePart> cut_profile(const std::vector<ProfilePart>& profile, double from, double to) {
  std::vector<ProfilePart> result;
  for (const auto& part : profile) {
    const double a = std::max(part.from, from), b = std::min(part.to, to);
    if (b - a <= same_place) continue;
    result.push_back({a - from, b - from, low_at(part, a), low_at(part, b), high_at(part, a), high_at(part, b)});
  }
  return result;
}

PlanRing outline_of(const std::vector<ProfilePart>& profile) {
  PlanRing ring;
  const auto add = [&](double s, double z) {
    const Eigen::Vector2d p(s, z);
    if (ring.empty() || (ring.back() - p).norm() > same_place) ring.push_back(p);
  };
  for (const auto& part : profile) {
    add(part.from, part.low_from);
    add(part.to, part.low_to);
  }
  for (auto part = profile.rbegin(); part != profile.rend(); ++part) {
    add(part->to, part->high_to);
    add(part->from, part->high_from);
  }
  while (ring.size() > 1 && (ring.back() - ring.front()).norm() <= same_place) ring.pop_back();
  return ring;
}

}  // namespace atrium::building
