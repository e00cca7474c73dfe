#include "modules/register/yaw_search.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "modules/geometry/quantile.hpp"

namespace atrium::registration {
namespace {

constexpr double column = 0.15;              // metres: edge of a ground cell, and of a cell of shifts
constexpr double min_height = 0.8;           // metres: what is lower is furniture
constexpr std::size_t source_columns = 600;  // that vote
constexpr std::size_t target_columns = 3000;
constexpr int yaws = 90;

/// Middles of ground cells above which points reach over min_height: walls, cupboards. At most about `most`, evenly.
std::vector<Eigen::Vector2d> upright_columns(const std::vector<Eigen::Vector3f>& points, std::size_t most) {
  struct Column {
    float low, high;
    int n;
  };
  std::map<std::pair<int, int>, Column> columns;
  for (const auto& p : points) {
    const Eigen::Vector2d at = (p.head<2>().cast<double>() / column).array().floor();
    if (at.cwiseAbs().maxCoeff() > 1e6) continue;
    auto& c = columns.try_emplace({static_cast<int>(at.x()), static_cast<int>(at.y())}, Column{p.z(), p.z(), 0})
                  .first->second;
    c.low = std::min(c.low, p.z());
    c.high = std::max(c.high, p.z());
    ++c.n;
  }
  std::vector<Eigen::Vector2d> result;
  // Floor and ceiling alone reach high too: a wall fills what is between them.
  for (const auto& [at, c] : columns)
    if (c.high - c.low > min_height && c.n >= 6)
      result.emplace_back((at.first + 0.5) * column, (at.second + 0.5) * column);
  const std::size_t stride = (result.size() + most - 1) / most;
  std::vector<Eigen::Vector2d> even;
  for (std::size_t i = 0; i < result.size(); i += std::max<std::size_t>(stride, 1)) even.push_back(result[i]);
  return even;
}

/// The height that the floors differ by: of the lowest 2 % of points.
double floor_height(const std::vector<Eigen::Vector3f>& points) {
  std::vector<float> heights;
  heights.reserve(points.size());
  for (const auto& p : points) heights.push_back(p.z());
  return ranked(heights, heights.size() / 50);
}

struct Start {
  double yaw = 0;
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  int votes = 0;
};

/// The shift that brings most columns together at one yaw.
Start best_shift(const std::vector<Eigen::Vector2d>& source, const std::vector<Eigen::Vector2d>& target, double yaw) {
  const Eigen::Rotation2Dd turn(yaw);
  std::vector<Eigen::Vector2d> turned;
  turned.reserve(source.size());
  for (const auto& s : source) turned.push_back(turn * s);
  // Shifts are counted around that which brings the middles together.
  Eigen::Array2d middle = Eigen::Array2d::Zero();
  for (const auto& t : target) middle += t.array() / static_cast<double>(target.size());
  for (const auto& s : turned) middle -= s.array() / static_cast<double>(turned.size());
  constexpr int half = 100;  // cells: 15 m to each side
  constexpr int width = 2 * half + 1;
  std::vector<int> votes(static_cast<std::size_t>(width) * width, 0);
  for (const auto& s : turned)
    for (const auto& t : target) {
      const Eigen::Array2d d = (t - s).array() - middle;
      const int x = static_cast<int>(std::lround(d.x() / column)) + half;
      const int y = static_cast<int>(std::lround(d.y() / column)) + half;
      if (x >= 0 && y >= 0 && x < width && y < width)
        ++votes[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)];
    }
  const auto most = std::max_element(votes.begin(), votes.end());
  const auto at = static_cast<int>(most - votes.begin());
  return {yaw, middle + column * Eigen::Array2d(at % width - half, at / width - half), *most};
}

}  // namespace

std::vector<Eigen::Isometry3d> search_yaw(const std::vector<Eigen::Vector3f>& source,
                                          const std::vector<Eigen::Vector3f>& target, std::size_t count,
                                          const Context& context) {
  const auto a = upright_columns(source, source_columns);
  const auto b = upright_columns(target, target_columns);
  if (a.empty() || b.empty()) return {};
  std::vector<Start> starts(yaws);
  context.parallel_for(
      starts.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          starts[i] = best_shift(a, b, 2 * std::numbers::pi * static_cast<double>(i) / yaws);
      },
      4);
  std::stable_sort(starts.begin(), starts.end(), [](const Start& l, const Start& r) { return l.votes > r.votes; });
  const double up = floor_height(target) - floor_height(source);
  std::vector<Start> chosen;
  for (const Start& s : starts) {
    const bool known = std::any_of(chosen.begin(), chosen.end(), [&](const Start& c) {
      return std::cos(c.yaw - s.yaw) > std::cos(0.15) && (c.shift - s.shift).norm() < 1;
    });
    if (!known && chosen.size() < count) chosen.push_back(s);
  }
  std::vector<Eigen::Isometry3d> result;
  for (const Start& s : chosen) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = Eigen::AngleAxisd(s.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    pose.translation() = Eigen::Vector3d(s.shift.x(), s.shift.y(), up);
    result.push_back(pose);
  }
  return result;
}

}  // namespace atrium::registration
