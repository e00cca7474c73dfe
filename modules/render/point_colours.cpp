#include "modules/render/point_colours.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "graph/api/error.hpp"
#include "modules/geometry/quantile.hpp"
#include "modules/geometry/triangle_tree.hpp"

namespace atrium::render {
namespace {

PointColours scaled(const std::vector<float>& values, ColourScale scale) {
  PointColours result;
  result.colours.reserve(values.size());
  for (const float value : values)
    result.colours.push_back(scale.map.at((value - scale.low) / (scale.high - scale.low)));
  result.scale = std::move(scale);
  return result;
}

}  // namespace

std::vector<std::uint32_t> evenly_chosen(std::size_t size, std::size_t most) {
  const std::size_t step = std::max<std::size_t>(1, (size + most - 1) / most);
  std::vector<std::uint32_t> chosen;
  chosen.reserve(size / step + 1);
  for (std::size_t i = 0; i < size; i += step) chosen.push_back(static_cast<std::uint32_t>(i));
  return chosen;
}

double round_up(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * decade >= value * (1 - 1e-9)) return step * decade;
  return 10 * decade;
}

PointColours height_colours(const Cloud& cloud, const std::vector<std::uint32_t>& chosen, const Transform& to_upright,
                            const ColourMap& map) {
  const Eigen::Vector3d up = to_upright.rotation.row(2).transpose();
  const double zero = up.dot(cloud.origin) + to_upright.translation.z();
  std::vector<float> heights;
  heights.reserve(chosen.size());
  for (const auto i : chosen) heights.push_back(static_cast<float>(up.dot(cloud.points[i].cast<double>())));
  const double low = quantile(heights, 0.005);
  const double high = std::max<double>(quantile(heights, 0.995), low + 1e-3);
  PointColours result = scaled(heights, {map, low, high, "height"});
  result.scale->low += zero;
  result.scale->high += zero;
  return result;
}

PointColours label_colours(const Cloud& cloud, const std::vector<std::uint32_t>& chosen, const ColourMap& map) {
  constexpr Colour grey{150, 150, 150};
  constexpr std::size_t most_named = 10;
  PointColours result;
  std::set<std::int32_t> labels;
  for (const auto i : chosen) {
    const std::int32_t label = cloud.labels[i];
    result.colours.push_back(label < 0 ? grey : map.of_class(static_cast<std::size_t>(label)));
    if (labels.size() <= most_named) labels.insert(std::max(label, -1));
  }
  if (labels.size() > most_named) return result;
  for (const auto label : labels)
    if (label >= 0) result.legend.emplace_back(fmt::format("{}", label), map.of_class(static_cast<std::size_t>(label)));
  if (labels.contains(-1)) result.legend.emplace_back("none", grey);
  return result;
}

PointColours distance_colours(const Cloud& cloud, const std::vector<std::uint32_t>& chosen, const Mesh& mesh,
                              bool with_sign, double end, const ColourMap& map, const Context& context) {
  const TriangleTree tree(mesh.vertices, mesh.triangles);
  if (tree.empty()) throw Error("the mesh that distances are measured to has no triangle");
  const Eigen::Vector3d shift = cloud.origin - mesh.origin;
  std::vector<float> distances(chosen.size());
  const auto measure = [&](std::size_t begin, std::size_t stop) {
    std::uint32_t last = TriangleTree::none;
    for (std::size_t i = begin; i < stop; ++i) {
      const Eigen::Vector3d place = cloud.points[chosen[i]].cast<double>() + shift;
      const auto nearest = tree.nearest(place, std::numeric_limits<double>::infinity(), last);
      last = nearest.triangle;
      double distance = std::sqrt(nearest.squared_distance);
      const auto& corners = mesh.triangles[last];
      const Eigen::Vector3d& a = mesh.vertices[corners[0]];
      const Eigen::Vector3d normal = (mesh.vertices[corners[1]] - a).cross(mesh.vertices[corners[2]] - a);
      if (with_sign && normal.dot(place - a) < 0) distance = -distance;
      distances[i] = static_cast<float>(distance);
    }
  };
  context.parallel_for(chosen.size(), measure);
  if (end <= 0) {
    std::vector<float> sizes(distances.size());
    std::transform(distances.begin(), distances.end(), sizes.begin(), [](float d) { return std::abs(d); });
    end = round_up(std::max<double>(quantile(std::move(sizes), 0.95), 1e-3));
  }
  return scaled(distances, {map, with_sign ? -end : 0, end, with_sign ? "signed distance" : "distance"});
}

}  // namespace atrium::render
