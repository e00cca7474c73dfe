#include "modules/baseline/vertex_clustering.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "modules/baseline/input_mesh.hpp"

namespace atrium::baseline {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Corners = std::array<std::uint32_t, 3>;

constexpr unsigned key_bits = 21;  // per axis
constexpr double most_cells = (1U << key_bits) - 2;

struct Clusters {
  double cell = 0;
  std::vector<std::uint64_t> keys;     // of each cluster, by first vertex
  std::vector<std::uint32_t> of;       // cluster of each vertex
  std::vector<Corners> triangles;      // what is left, by the source's order
  std::vector<std::uint32_t> sources;  // triangle of the source
};

Vector3d low_corner(std::uint64_t key, const Vector3d& low, double cell) {
  constexpr std::uint64_t mask = (1U << key_bits) - 1;
  return low + cell * Vector3d(static_cast<double>(key >> (2 * key_bits)),
                               static_cast<double>((key >> key_bits) & mask), static_cast<double>(key & mask));
}

void assign_cells(const Mesh& mesh, const Vector3d& low, Clusters& clusters, const Context& context) {
  std::vector<std::uint64_t> keys(mesh.vertices.size());
  context.parallel_for(keys.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vector3d cell = (mesh.vertices[i] - low) / clusters.cell;
      std::uint64_t key = 0;
      for (int axis = 0; axis < 3; ++axis) key = key << key_bits | static_cast<std::uint64_t>(cell[axis]);
      keys[i] = key;
    }
  });
  std::unordered_map<std::uint64_t, std::uint32_t> index;
  index.reserve(keys.size() / 8);
  clusters.of.resize(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const auto [place, added] = index.try_emplace(keys[i], static_cast<std::uint32_t>(clusters.keys.size()));
    if (added) clusters.keys.push_back(keys[i]);
    clusters.of[i] = place->second;
  }
}

// Triangles over three clusters, each orientation of three corners once: the first.
void collapse(const Mesh& mesh, Clusters& clusters) {
  struct Found {
    Corners corners;
    std::uint32_t source;
  };
  std::vector<Found> found;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    Corners c{clusters.of[v[0]], clusters.of[v[1]], clusters.of[v[2]]};
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
    found.push_back({c, t});
  }
  std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
    return std::tie(a.corners, a.source) < std::tie(b.corners, b.source);
  });
  const auto last =
      std::unique(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.corners == b.corners; });
  found.erase(last, found.end());
  std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.source < b.source; });
  for (const auto& f : found) {
    clusters.triangles.push_back(f.corners);
    clusters.sources.push_back(f.source);
  }
}

Clusters clustered(const Mesh& mesh, const Eigen::AlignedBox3d& box, double cell, const Context& context) {
  context.check_cancelled();
  Clusters clusters;
  clusters.cell = cell;
  assign_cells(mesh, box.min(), clusters, context);
  collapse(mesh, clusters);
  return clusters;
}

// The finest grid of cells of at least `cell` that leaves at most `target` triangles.
Clusters search(const Mesh& mesh, const Eigen::AlignedBox3d& box, double cell, std::size_t target,
                const Context& context) {
  Clusters best = clustered(mesh, box, cell, context);
  if (best.triangles.size() <= target) return best;
  double fine = cell;
  double coarse = box.sizes().maxCoeff() * 1.001;  // one cube holds all: no triangle is left
  best = clustered(mesh, box, coarse, context);
  while (coarse / fine > 1.0001 && best.triangles.size() < target - target / 100) {
    Clusters middle = clustered(mesh, box, std::sqrt(fine * coarse), context);
    if (middle.triangles.size() > target) {
      fine = middle.cell;
    } else {
      coarse = middle.cell;
      best = std::move(middle);
    }
  }
  return best;
}

struct VertexQuadric {
  Matrix3d a = Matrix3d::Zero();
  Vector3d b = Vector3d::Zero();
};

Vector3d least_error(const VertexQuadric& quadric, const Vector3d& mean) {
  Eigen::JacobiSVD<Matrix3d> svd(quadric.a, Eigen::ComputeFullU | Eigen::ComputeFullV);
  svd.setThreshold(1e-3);
  return mean + svd.solve(Vector3d(quadric.b - quadric.a * mean));
}

void move_to_least_error(const Mesh& mesh, const Clusters& clusters, const Vector3d& low,
                         std::vector<Vector3d>& places) {
  std::vector<VertexQuadric> quadrics(places.size());
  for (const auto& t : mesh.triangles) {
    const Vector3d first = mesh.vertices[t[0]] - low;
    const Vector3d normal =
        (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    const Matrix3d a = normal * normal.transpose();  // weighted by the square of the area
    for (const auto corner : t) {
      quadrics[clusters.of[corner]].a += a;
      quadrics[clusters.of[corner]].b += a * first;
    }
  }
  const Vector3d cube = Vector3d::Constant(clusters.cell);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vector3d corner = low_corner(clusters.keys[i], low, clusters.cell);
    const Vector3d place = low + least_error(quadrics[i], places[i] - low);
    if (place.allFinite()) places[i] = place.cwiseMax(corner).cwiseMin(corner + cube);
  }
}

// Mean place and colour of each cluster's triangle corners.
void average(const Mesh& mesh, const Clusters& clusters, const Vector3d& low, std::vector<Vector3d>& places,
             std::vector<Colour>& colours) {
  std::vector<Vector3d> sums(clusters.keys.size(), Vector3d::Zero()), tints(sums);
  std::vector<double> counts(sums.size(), 0);
  for (const auto& t : mesh.triangles) {
    for (const auto corner : t) {
      const auto cluster = clusters.of[corner];
      sums[cluster] += mesh.vertices[corner] - low;
      counts[cluster] += 1;
      if (mesh.colours.empty()) continue;
      for (int k = 0; k < 3; ++k) tints[cluster][k] += mesh.colours[corner][static_cast<std::size_t>(k)];
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double weight = counts[i] > 0 ? 1 / counts[i] : 0;  // vertices without a triangle are not used
    places.emplace_back(low + sums[i] * weight);
    const Vector3d tint = tints[i] * weight;
    if (!mesh.colours.empty())
      colours.push_back({static_cast<std::uint8_t>(std::lround(tint.x())),
                         static_cast<std::uint8_t>(std::lround(tint.y())),
                         static_cast<std::uint8_t>(std::lround(tint.z()))});
  }
}

}  // namespace

VertexClustering::Out VertexClustering::run(const In& in, const Params& params, Context& context) {
  const Mesh& mesh = *in.mesh;
  check_mesh(mesh);
  const std::size_t count = mesh.triangles.size();
  const bool has_target = params.triangles > 0 || params.ratio > 0 || !(params.cell_size > 0);
  const std::size_t target = has_target ? target_triangles(count, params.triangles, params.ratio) : count;
  Out out;
  out.mesh.origin = mesh.origin;
  if (count == 0) return out;

  Eigen::AlignedBox3d box;
  for (const auto& v : mesh.vertices) box.extend(v);
  const double extent = box.sizes().maxCoeff();
  if (!(extent > 0)) return out;
  const double cell = std::max(params.cell_size, extent / most_cells);
  const Clusters clusters = search(mesh, box, cell, target, context);

  std::vector<Vector3d> places;
  std::vector<Colour> colours;
  average(mesh, clusters, box.min(), places, colours);
  if (params.representative == Representative::quadric) move_to_least_error(mesh, clusters, box.min(), places);
  out.mesh = with_columns(mesh, clusters.triangles, clusters.sources);
  place_used_vertices(places, colours, out.mesh);
  out.cell_size = clusters.cell;
  return out;
}

}  // namespace atrium::baseline
