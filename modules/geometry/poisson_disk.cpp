#include "modules/geometry/poisson_disk.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "graph/api/error.hpp"
#include "modules/geometry/point_grid.hpp"

namespace atrium {
namespace {

constexpr std::size_t oversampling = 5;

/// Running sums of the triangles' areas.
std::vector<double> areas(const Mesh& mesh) {
  for (const auto& v : mesh.vertices)
    if (!v.allFinite()) throw Error("the mesh has a vertex that is not finite");
  std::vector<double> sums;
  sums.reserve(mesh.triangles.size());
  double total = 0;
  for (const auto& t : mesh.triangles) {
    for (const auto v : t)
      if (v >= mesh.vertices.size())
        throw Error(fmt::format("a triangle names vertex {}, but the mesh has {}", v, mesh.vertices.size()));
    const Eigen::Vector3d& a = mesh.vertices[t[0]];
    total += (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm() / 2;
    sums.push_back(total);
  }
  if (!(total > 0)) throw Error("the mesh has no surface to sample", "it needs a triangle with an area");
  return sums;
}

Colour blend(const Mesh& mesh, const std::array<std::uint32_t, 3>& t, double u, double v) {
  Colour result{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double value = (1 - u - v) * mesh.colours[t[0]][c] + u * mesh.colours[t[1]][c] + v * mesh.colours[t[2]][c];
    result[c] = static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
  }
  return result;
}

/// Uniform samples, stratified by area along the list of triangles.
Cloud uniform_samples(const Mesh& mesh, const std::vector<double>& sums, std::size_t count, const Context& context) {
  Cloud cloud;
  cloud.origin = mesh.origin;
  cloud.points.resize(count);
  cloud.normals.resize(count);
  cloud.colours.resize(mesh.colours.empty() ? 0 : count);
  context.parallel_chunks(count, 8192, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    Random random = context.random(chunk);
    for (std::size_t i = begin; i < end; ++i) {
      const double at = (static_cast<double>(i) + random.uniform()) / static_cast<double>(count) * sums.back();
      // upper_bound passes over triangles without area; rounding must not lead behind the last one that has any
      const auto found = std::min(std::upper_bound(sums.begin(), sums.end(), at),
                                  std::lower_bound(sums.begin(), sums.end(), sums.back()));
      const auto& t = mesh.triangles[static_cast<std::size_t>(found - sums.begin())];
      double u = random.uniform(), v = random.uniform();
      if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
      }
      const Eigen::Vector3d& a = mesh.vertices[t[0]];
      const Eigen::Vector3d ab = mesh.vertices[t[1]] - a, ac = mesh.vertices[t[2]] - a;
      cloud.points[i] = (a + u * ab + v * ac).cast<float>();
      cloud.normals[i] = ab.cross(ac).normalized().cast<float>();
      if (!mesh.colours.empty()) cloud.colours[i] = blend(mesh, t, u, v);
    }
  });
  return cloud;
}

/// Yuksel's weight of a neighbour at a distance (alpha = 8), without the limiting of close samples (his beta), which
/// does not change the order here.
float weight(float distance, float reach) {
  const float w = 1 - std::min(distance / reach, 1.0F);
  const float w2 = w * w, w4 = w2 * w2;
  return w4 * w4;
}

/// A binary heap with the heaviest sample on top (the lowest index of equals) that can make samples lighter. Samples
/// stand where their weights of some time ago belong: what has become lighter sinks when it comes to the top.
class Heap {
 public:
  explicit Heap(std::vector<float> weights) : weights_(std::move(weights)), heap_(weights_.size()) {
    for (std::uint32_t i = 0; i < heap_.size(); ++i) heap_[i] = {weights_[i], i};
    std::make_heap(heap_.begin(), heap_.end(), lighter);
  }
  std::size_t size() const { return heap_.size(); }
  std::uint32_t pop() {
    while (heap_.front().weight != weights_[heap_.front().sample]) {
      heap_.front().weight = weights_[heap_.front().sample];
      sink();
    }
    const std::uint32_t top = heap_.front().sample;
    heap_.front() = heap_.back();
    heap_.pop_back();
    if (!heap_.empty()) sink();
    return top;
  }
  void lighten(std::uint32_t sample, float by) { weights_[sample] -= by; }
  std::vector<std::uint32_t> rest() const {
    std::vector<std::uint32_t> result;
    result.reserve(heap_.size());
    for (const Item& item : heap_) result.push_back(item.sample);
    std::sort(result.begin(), result.end());
    return result;
  }

 private:
  struct Item {
    float weight;
    std::uint32_t sample;
  };
  static bool lighter(const Item& a, const Item& b) {
    return a.weight != b.weight ? a.weight < b.weight : a.sample > b.sample;
  }
  /// Moves the top to its place.
  void sink() {
    const Item item = heap_.front();
    std::size_t i = 0;
    for (std::size_t child = 1; child < heap_.size(); child = 2 * i + 1) {
      if (child + 1 < heap_.size() && lighter(heap_[child], heap_[child + 1])) ++child;
      if (!lighter(item, heap_[child])) break;
      heap_[i] = heap_[child];
      i = child;
    }
    heap_[i] = item;
  }
  std::vector<float> weights_;  // as they are now
  std::vector<Item> heap_;
};

/// Calls work(other, distance) for the samples nearer than `reach` to one; samples stand in the grid's order.
template <class Work>
void each_near(const PointGrid& grid, const PointGrid::Cell& cell, std::uint32_t sample, float reach,
               const Work& work) {
  const auto& points = grid.points();
  for (const auto c : grid.neighbourhood(cell)) {
    if (c == PointGrid::none) continue;
    for (std::uint32_t i = grid.cells()[c].begin; i < grid.cells()[c].end; ++i) {
      const float d2 = (points[i] - points[sample]).squaredNorm();
      if (d2 < reach * reach && i != sample) work(i, std::sqrt(d2));
    }
  }
}

/// The `count` samples (positions in the grid's order) that remain when the most crowded one is taken away again and
/// again.
std::vector<std::uint32_t> eliminate(const PointGrid& grid, std::size_t count, float reach, const Context& context) {
  std::vector<float> weights(grid.inside(), 0);
  std::vector<std::uint32_t> cell_of(grid.inside());
  context.parallel_for(
      grid.cells().size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c)
          for (std::uint32_t i = grid.cells()[c].begin; i < grid.cells()[c].end; ++i) {
            cell_of[i] = static_cast<std::uint32_t>(c);
            each_near(grid, grid.cells()[c], i, reach,
                      [&](std::uint32_t, float distance) { weights[i] += weight(distance, reach); });
          }
      },
      512);
  Heap heap(std::move(weights));
  while (heap.size() > count) {
    if (heap.size() % 65536 == 0) context.check_cancelled();
    const std::uint32_t top = heap.pop();
    each_near(grid, grid.cells()[cell_of[top]], top, reach,
              [&](std::uint32_t other, float distance) { heap.lighten(other, weight(distance, reach)); });
  }
  return heap.rest();
}

}  // namespace

Cloud sample_poisson_disk(const Mesh& mesh, std::size_t count, const Context& context) {
  const std::vector<double> sums = areas(mesh);
  if (count == 0) return {mesh.origin, {}, {}, {}, {}, {}, {}, {}};
  if (count > (std::size_t{1} << 29U)) throw Error(fmt::format("{} samples of a mesh are too many", count));
  const Cloud samples = uniform_samples(mesh, sums, oversampling * count, context);
  // No two of `count` disks in the area can be further apart than 2 r_max.
  const double r_max = std::sqrt(sums.back() / (2 * std::numbers::sqrt3 * static_cast<double>(count)));
  const PointGrid grid(samples.points, 2 * r_max, context);
  if (grid.inside() < count) throw Error("the mesh is too wide for so many samples", "look for vertices far off");
  std::vector<std::uint32_t> kept = eliminate(grid, count, static_cast<float>(2 * r_max), context);
  for (auto& k : kept) k = grid.order()[k];
  return select(samples, kept);
}

}  // namespace atrium
