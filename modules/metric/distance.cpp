#include "modules/metric/distance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "modules/geometry/quantile.hpp"
#include "modules/metric/mesh_samples.hpp"
#include "modules/metric/point_distance.hpp"

namespace atrium::metric {
namespace {

constexpr std::size_t chunk_size = 8192;
constexpr double high = 0.95;  // the quantile

struct Summary {
  double mean = 0, rms = 0, median = 0, p95 = 0, trimmed_rms = 0, max = 0, beyond = 0;
  std::optional<double> within_rms;  // none if nothing is within the limit
};

// The least of the distances that has the share of all of them at or below it.
float nearest_rank(std::vector<float>& distances, double share) {
  const auto k = static_cast<std::size_t>(std::ceil(share * static_cast<double>(distances.size())));
  return ranked(distances, std::max<std::size_t>(k, 1) - 1);
}

// Of distances that all count the same. Partial sums are joined in order, so threads change no bit.
Summary summarise(const std::vector<float>& distances, double limit, const Context& context) {
  std::vector<float> copy = distances;
  const float median = nearest_rank(copy, 0.5), p95 = nearest_rank(copy, high);
  struct Part {
    double sum = 0, squares = 0, below_squares = 0, within_squares = 0;
    std::size_t below = 0, within = 0;
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
      if (distances[i] < p95) {
        part.below_squares += d * d;
        ++part.below;
      }
      if (d <= limit) {
        part.within_squares += d * d;
        ++part.within;
      }
    }
    parts[chunk] = part;
  });
  Part all;
  for (const auto& p : parts)
    all = {all.sum + p.sum,
           all.squares + p.squares,
           all.below_squares + p.below_squares,
           all.within_squares + p.within_squares,
           all.below + p.below,
           all.within + p.within,
           std::max(all.max, p.max)};
  const auto n = static_cast<double>(distances.size());
  const double kept = std::max(1.0, std::ceil(high * n)), equal = kept - static_cast<double>(all.below);
  Summary s{all.sum / n, std::sqrt(all.squares / n), median, p95};
  s.trimmed_rms = std::sqrt((all.below_squares + equal * static_cast<double>(p95) * p95) / kept);
  s.max = all.max;
  s.beyond = (n - static_cast<double>(all.within)) / n;
  if (all.within > 0) s.within_rms = std::sqrt(all.within_squares / static_cast<double>(all.within));
  return s;
}

// Of distances that count by their weights.
Summary summarise(const std::vector<double>& distances, const std::vector<double>& weights, double limit) {
  std::vector<std::uint32_t> order(distances.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return distances[a] != distances[b] ? distances[a] < distances[b] : a < b;
  });
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  Summary s;
  double passed = 0, squares = 0, within = 0;
  bool past_half = false, past_high = false;
  for (const auto i : order) {
    const double d = distances[i];
    passed += weights[i];
    squares += weights[i] * d * d;
    s.mean += weights[i] * d / total;
    s.max = d;
    if (d <= limit) {
      within = passed;
      s.within_rms = squares;
    }
    if (!past_half) s.median = d;
    past_half = passed >= 0.5 * total;
    if (past_high) continue;
    s.p95 = d;
    past_high = passed >= high * total;
    // Of the last one only the part counts that fills up the share.
    s.trimmed_rms =
        std::sqrt((squares - std::max(0.0, passed - high * total) * d * d) / std::min(passed, high * total));
  }
  s.rms = std::sqrt(squares / total);
  s.beyond = std::max(0.0, total - within) / total;
  s.within_rms = within > 0 ? std::optional(std::sqrt(*s.within_rms / within)) : std::nullopt;
  return s;
}

void report(Metrics& metrics, const std::string& name, const Summary& s, double diagonal) {
  const std::array<std::pair<const char*, double>, 6> values{{{"mean", s.mean},
                                                              {"rms", s.rms},
                                                              {"median", s.median},
                                                              {"p95", s.p95},
                                                              {"trimmed_rms", s.trimmed_rms},
                                                              {"max", s.max}}};
  for (const auto& [key, value] : values) metrics.values.push_back({name + "." + key, value, "m"});
  metrics.values.push_back({name + ".beyond", s.beyond, ""});
  if (s.within_rms) metrics.values.push_back({name + ".within_rms", *s.within_rms, "m"});
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
  return summarise(distances, samples.weights, params.limit);
}

// About the cloud's origin, so that single precision holds for both.
Mesh about(const Mesh& mesh, const Eigen::Vector3d& origin, const std::string& what) {
  check_mesh(mesh, what);
  Mesh result;
  result.vertices = vertices_about(mesh, origin);
  result.triangles = mesh.triangles;
  return result;
}

bool has_area(const Mesh& mesh) { return sample_mesh(mesh, 1e9, 1).area > 0; }

// What concerns the structure alone: the points near the true one, and the reconstructed one.
void report_structure(Metrics& metrics, const Distance::In& in, const PointGrid& grid, double diagonal,
                      const Distance::Params& params, const Context& context) {
  const Mesh structure = about(*in.structure, in.cloud->origin, "the structure");
  if (!has_area(structure)) {
    context.warn("the structure has no area: its distances are left out");
    return;
  }
  if (in.truth) {
    const Mesh truth = about(*in.truth, in.cloud->origin, "the truth");
    if (!has_area(truth)) throw Error("the truth has no area: no point is near it");
    const auto to_truth = distances_to_mesh(grid, {truth.vertices, truth.triangles}, context);
    const auto to_structure = distances_to_mesh(grid, {structure.vertices, structure.triangles}, context);
    std::vector<float> kept;
    for (std::size_t i = 0; i < to_truth.size(); ++i)
      if (to_truth[i] <= params.truth_distance) kept.push_back(to_structure[i]);
    if (kept.empty())
      context.warn("no point of the cloud is near the true structure: is it in the same frame?");
    else
      report(metrics, "distance.structure.cloud_to_mesh", summarise(kept, params.limit, context), diagonal);
  }
  report(metrics, "distance.structure.mesh_to_cloud", mesh_to_cloud(structure, grid, params, context), diagonal);
}

}  // namespace

Distance::Out Distance::run(const In& in, const Params& params, Context& context) {
  if (in.cloud->points.empty()) throw Error("the cloud has no points: it has no distance to the mesh");
  for (std::size_t i = 0; i < in.cloud->points.size(); ++i)
    if (!in.cloud->points[i].allFinite())
      throw Error("point " + std::to_string(i) + " of the cloud is not finite", "remove it: io.read_cloud does");
  if (in.truth && !in.structure)
    throw Error("truth is wired, but structure is not", "wire both: the structure's points are those near the truth");
  const Mesh mesh = about(*in.mesh, in.cloud->origin, "the mesh");
  if (!has_area(mesh))
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
  const auto distances = distances_to_mesh(grid, tree, context);
  report(out.metrics, "distance.cloud_to_mesh", summarise(distances, params.limit, context), diagonal);
  report(out.metrics, "distance.mesh_to_cloud", mesh_to_cloud(mesh, grid, params, context), diagonal);
  if (in.structure) report_structure(out.metrics, in, grid, diagonal, params, context);
  return out;
}

}  // namespace atrium::metric
