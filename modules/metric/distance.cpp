#include "modules/metric/distance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "modules/metric/mesh_samples.hpp"
#include "modules/metric/point_distance.hpp"

namespace atrium::metric {
namespace {

constexpr std::size_t chunk_size = 8192;
constexpr double high = 0.95;  // the quantile

struct Summary {
  double mean = 0, rms = 0, p95 = 0, max = 0;
};

// Of distances that all count the same. Partial sums are joined in order, so threads change no bit.
Summary summarise(std::vector<float> distances, const Context& context) {
  struct Part {
    double sum = 0, squares = 0;
    float max = 0;
  };
  std::vector<Part> parts((distances.size() + chunk_size - 1) / chunk_size);
  context.parallel_chunks(distances.size(), chunk_size, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    Part part;
    for (std::size_t i = begin; i < end; ++i) {
      const double d = distances[i];
      part.sum += d;
      part.squares += d * d;
      part.max = std::max(part.max, distances[i]);
    }
    parts[chunk] = part;
  });
  Part all;
  for (const auto& p : parts) all = {all.sum + p.sum, all.squares + p.squares, std::max(all.max, p.max)};
  const auto n = static_cast<double>(distances.size());
  const auto at = distances.begin() + static_cast<std::ptrdiff_t>(std::ceil(high * n)) - 1;
  std::nth_element(distances.begin(), at, distances.end());
  return {all.sum / n, std::sqrt(all.squares / n), *at, all.max};
}

Summary summarise(const std::vector<double>& distances, const std::vector<double>& weights) {
  Summary s;
  double total = 0;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    total += weights[i];
    s.mean += weights[i] * distances[i];
    s.rms += weights[i] * distances[i] * distances[i];
    s.max = std::max(s.max, distances[i]);
  }
  s.mean /= total;
  s.rms = std::sqrt(s.rms / total);
  std::vector<std::uint32_t> order(distances.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return distances[a] != distances[b] ? distances[a] < distances[b] : a < b;
  });
  double passed = 0;
  for (const auto i : order) {
    passed += weights[i];
    s.p95 = distances[i];
    if (passed >= high * total) break;
  }
  return s;
}

void report(Metrics& metrics, const std::string& name, const Summary& s, double diagonal) {
  const std::array<std::pair<const char*, double>, 4> values{
      {{"mean", s.mean}, {"rms", s.rms}, {"p95", s.p95}, {"max", s.max}}};
  for (const auto& [key, value] : values) metrics.values.push_back({name + "." + key, value, "m"});
  for (const auto& [key, value] : values)
    metrics.values.push_back({name + ".relative." + key, diagonal > 0 ? value / diagonal : 0, ""});
}

Summary mesh_to_cloud(const Mesh& mesh, const PointGrid& grid, const Distance::Params& params, const Context& context) {
  MeshSamples samples = sample_mesh(mesh, params.spacing, static_cast<double>(params.max_samples));
  if (samples.spacing > params.spacing)
    context.warn("the mesh has " + std::to_string(samples.area) + " m2: its samples stand " +
                 std::to_string(samples.spacing) + " m apart, as max_samples wants it");
  // Vertices weigh nothing but count for the maximum.
  std::vector<bool> used(mesh.vertices.size(), false);
  for (const auto& t : mesh.triangles)
    for (const auto v : t) used[v] = true;
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (!used[v]) continue;
    samples.points.push_back(mesh.vertices[v]);
    samples.weights.push_back(0);
  }
  const CloudSearch search(grid, context);
  std::vector<double> distances(samples.points.size());
  context.parallel_for(
      distances.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) distances[i] = search.nearest(samples.points[i]);
      },
      1024);
  return summarise(distances, samples.weights);
}

double total_area(const Mesh& mesh) { return sample_mesh(mesh, 1e9, 1).area; }

}  // namespace

Distance::Out Distance::run(const In& in, const Params& params, Context& context) {
  if (in.cloud->points.empty()) throw Error("the cloud has no points: it has no distance to the mesh");
  check_mesh(*in.mesh, "the mesh");
  // About the cloud's origin, so that single precision holds for both.
  Mesh mesh;
  mesh.vertices = vertices_about(*in.mesh, in.cloud->origin);
  mesh.triangles = in.mesh->triangles;
  if (!(total_area(mesh) > 0))
    throw Error("the mesh has no area: it has no distance to the cloud",
                "look at the step that made the mesh; it gave " + std::to_string(mesh.triangles.size()) + " triangles");
  Eigen::AlignedBox3f cloud_box;
  for (const auto& p : in.cloud->points) cloud_box.extend(p);
  Eigen::AlignedBox3d mesh_box;
  for (const auto& t : mesh.triangles)
    for (const auto v : t) mesh_box.extend(mesh.vertices[v]);
  const double diagonal = cloud_box.cast<double>().diagonal().norm();
  // Cells of some decimetres in a building; the smaller box, lest one wild point makes them huge.
  const double cell = std::max(1e-6, std::min(diagonal > 0 ? diagonal : 1, mesh_box.diagonal().norm()) / 150);

  const PointGrid grid(in.cloud->points, cell, context);
  const TriangleTree tree(mesh.vertices, mesh.triangles);
  Out out;
  out.metrics.values.push_back({"distance.diagonal", diagonal, "m"});
  report(out.metrics, "distance.cloud_to_mesh", summarise(distances_to_mesh(grid, tree, context), context), diagonal);
  report(out.metrics, "distance.mesh_to_cloud", mesh_to_cloud(mesh, grid, params, context), diagonal);
  return out;
}

}  // namespace atrium::metric
