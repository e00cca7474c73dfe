#include "modules/object/surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "graph/api/error.hpp"
#include "graph/api/text.hpp"
#include "modules/geometry/point_tree.hpp"
#include "modules/geometry/quantile.hpp"

namespace atrium::object {
namespace {

constexpr std::uint32_t nothing = 0xffffffffU;

/// For each position the nearest point within max_distance, or `nothing`.
std::vector<std::uint32_t> nearest_points(const std::vector<Eigen::Vector3f>& positions, const PointTree& tree,
                                          double max_distance, const Context& context) {
  std::vector<std::uint32_t> result(positions.size(), nothing);
  context.parallel_for(positions.size(), [&](std::size_t begin, std::size_t end) {
    Neighbour neighbour{};
    for (std::size_t i = begin; i < end; ++i)
      if (tree.nearest(positions[i], neighbour, static_cast<float>(max_distance))) result[i] = neighbour.index;
  });
  return result;
}

}  // namespace

bool is_surface(const Cloud& cloud, const Context& context) {
  if (cloud.size() < least_points) {
    context.info(counted(cloud.size(), "point is", "points are") + " no surface: the mesh is empty");
    return false;
  }
  if (!cloud.has_normals())
    throw Error("the cloud has no normals", "estimate them before with normal.estimate and normal.orient");
  Eigen::Vector3f low = cloud.points.front();
  Eigen::Vector3f high = low;
  for (const auto& p : cloud.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  constexpr float least_extent = 1e-4F;  // metres
  if ((high - low).maxCoeff() < least_extent) {
    context.info(fmt::format("all {} points are in one place: the mesh is empty", cloud.size()));
    return false;
  }
  return true;
}

double surface_spacing(const Cloud& cloud, const Context& context) {
  constexpr std::size_t most_places = 10000;
  const PointTree tree(cloud.points, context);
  const std::size_t step = cloud.size() / most_places + 1;
  const std::size_t neighbours = std::min<std::size_t>(16, cloud.size() - 1);
  std::vector<double> squares((cloud.size() + step - 1) / step);
  context.parallel_for(squares.size(), [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbour> found;
    for (std::size_t i = begin; i < end; ++i) {
      tree.k_nearest(cloud.points[i * step], neighbours + 1, found);  // the first is the point itself
      squares[i] = static_cast<double>(found.back().squared_distance);
    }
  });
  return std::sqrt(std::numbers::pi * median(std::move(squares)) / static_cast<double>(neighbours));
}

Mesh finished(const RawSurface& surface, const Cloud& cloud, double max_distance, const Context& context) {
  const PointTree tree(cloud.points, context);
  const auto nearest = nearest_points(surface.vertices, tree, max_distance, context);
  std::vector<Eigen::Vector3f> middles;
  middles.reserve(surface.triangles.size());
  for (const auto& t : surface.triangles)
    middles.emplace_back((surface.vertices[t[0]] + surface.vertices[t[1]] + surface.vertices[t[2]]) / 3.0F);
  const auto nearest_to_middle = nearest_points(middles, tree, max_distance, context);

  Mesh mesh;
  mesh.origin = cloud.origin;
  std::vector<std::uint32_t> place(surface.vertices.size(), nothing);
  const auto vertex = [&](std::uint32_t old) {
    if (place[old] == nothing) {
      place[old] = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.emplace_back(surface.vertices[old].cast<double>());
      if (!cloud.colours.empty()) mesh.colours.push_back(cloud.colours[nearest[old]]);
    }
    return place[old];
  };
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const auto& t = surface.triangles[i];
    if (nearest_to_middle[i] == nothing) continue;
    if (std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return nearest[v] == nothing; })) continue;
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    const std::uint32_t a = vertex(t[0]);
    const std::uint32_t b = vertex(t[1]);
    const std::uint32_t c = vertex(t[2]);
    mesh.triangles.push_back({a, b, c});
  }
  mesh.classes.assign(mesh.triangles.size(), SurfaceClass::object);
  mesh.storeys.assign(mesh.triangles.size(), -1);
  mesh.primitives.assign(mesh.triangles.size(), -1);
  return mesh;
}

}  // namespace atrium::object
