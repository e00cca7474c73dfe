#include "modules/baseline/storey_heights.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "graph/api/error.hpp"
#include "modules/geometry/quantile.hpp"

namespace atrium::baseline {
namespace {

constexpr float level = 0.8F;  // |nz| of floors and ceilings, at least
constexpr double near_height = 0.05;
constexpr double bin = 0.05;
constexpr double thickest_slab = 1, lowest_storey = 1.8;
constexpr double least_share = 0.2;
constexpr double most_bins = 1e6;

double median_near(std::vector<double> heights, double height) {
  std::erase_if(heights, [&](double z) { return std::abs(z - height) > near_height; });
  return median(std::move(heights));
}

// The local maxima of a profile, three bins wide, that reach the share of the greatest.
std::vector<double> peaks(const std::vector<double>& counts, double low) {
  std::vector<double> wide(counts.size(), 0);
  for (std::size_t i = 1; i + 1 < counts.size(); ++i) wide[i] = counts[i - 1] + counts[i] + counts[i + 1];
  const double least = least_share * *std::max_element(wide.begin(), wide.end());
  std::vector<double> result;
  for (std::size_t i = 1; i + 1 < wide.size(); ++i)
    if (wide[i] > 0 && wide[i] >= least && wide[i] > wide[i - 1] && wide[i] >= wide[i + 1])
      result.push_back(low + (static_cast<double>(i) + 0.5) * bin);
  return result;
}

}  // namespace

bool is_level(const Cloud& cloud, std::size_t i) {
  return !cloud.has_normals() || std::abs(cloud.normals[i].z()) >= level;
}

StoreyHeights storey_heights(const Cloud& cloud, double percentile) {
  std::vector<double> heights;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (is_level(cloud, i)) heights.push_back(cloud.points[i].z());
  constexpr std::size_t least = 100;
  if (heights.size() < least)
    throw Error(fmt::format("{} points of floor and ceiling are too few for their heights", heights.size()),
                "a cloud with z up is needed, of a whole storey");
  std::sort(heights.begin(), heights.end());
  const auto rank = static_cast<std::size_t>(percentile * static_cast<double>(heights.size() - 1));
  StoreyHeights result{median_near(heights, heights[rank]), median_near(heights, heights[heights.size() - 1 - rank])};
  if (result.ceiling - result.floor < 1)
    throw Error(fmt::format("floor and ceiling are {:.2f} m apart", result.ceiling - result.floor),
                "a cloud with z up is needed, of a whole storey");
  return result;
}

std::vector<double> storey_bounds(const Cloud& cloud) {
  if (cloud.size() == 0) return {};
  double low = cloud.points.front().z(), high = low;
  for (const auto& p : cloud.points) {
    low = std::min(low, static_cast<double>(p.z()));
    high = std::max(high, static_cast<double>(p.z()));
  }
  low -= bin;  // an empty bin at either end
  const double bins = std::floor((high - low) / bin) + 2;
  if (!(bins < most_bins)) return {};
  std::vector<double> up(static_cast<std::size_t>(bins), 0), down = up;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!is_level(cloud, i)) continue;
    const auto at = static_cast<std::size_t>((cloud.points[i].z() - low) / bin);
    if (!cloud.has_normals() || cloud.normals[i].z() > 0) ++up[at];
    if (!cloud.has_normals() || cloud.normals[i].z() < 0) ++down[at];
  }
  const auto floors = peaks(up, low), ceilings = peaks(down, low);
  std::vector<double> bounds;
  if (floors.empty() || ceilings.empty()) return bounds;
  double bottom = floors.front();
  for (const double ceiling : ceilings) {
    const auto floor = std::find_if(floors.begin(), floors.end(), [&](double f) { return f > ceiling + bin; });
    if (floor == floors.end() || *floor > ceiling + thickest_slab) continue;
    if (ceiling - bottom < lowest_storey || ceilings.back() - *floor < lowest_storey) continue;
    bounds.push_back((ceiling + *floor) / 2);
    bottom = *floor;
  }
  return bounds;
}

Cloud between_heights(const Cloud& cloud, double low, double high) {
  Cloud part;
  part.origin = cloud.origin;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double z = cloud.points[i].z();
    if (!(z >= low && z < high)) continue;
    part.points.push_back(cloud.points[i]);
    if (cloud.has_normals()) part.normals.push_back(cloud.normals[i]);
  }
  return part;
}

}  // namespace atrium::baseline
