#include "modules/baseline/planar_partition.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

#include "modules/baseline/area_moments.hpp"
#include "modules/baseline/region_merging.hpp"

namespace atrium::baseline {
namespace {

using Eigen::Vector3d;

constexpr std::int32_t unassigned = -1;
constexpr int smoothing_rounds = 3;  // of the normals
constexpr int border_rounds = 6;
constexpr double loose_cosine = 0.2;  // of the own normal of what joins a region after it has grown

class Growing {
 public:
  Growing(const Mesh& mesh, const FaceNeighbours& neighbours, const PartitionLimits& limits, const Context& context)
      : mesh_(mesh), neighbours_(neighbours), limits_(limits), context_(context) {
    cosine_ = std::cos(limits.angle * std::numbers::pi / 180);
    region_.assign(mesh.triangles.size(), unassigned);
  }

  PlanarPartition run() {
    smooth_normals();
    grow_all();
    merge_regions(neighbours_, limits_, region_, moments_);
    planes_.clear();
    for (const auto& m : moments_) planes_.push_back(m.plane());
    join_neighbours();
    smooth_borders();
    return by_area();
  }

 private:
  std::array<Vector3d, 3> corners(std::size_t t) const {
    const auto& v = mesh_.triangles[t];
    return {mesh_.vertices[v[0]], mesh_.vertices[v[1]], mesh_.vertices[v[2]]};
  }
  bool lies_in(std::size_t t, const Plane& plane, double distance) const {
    for (const auto v : mesh_.triangles[t])
      if (std::abs(plane.signed_distance(mesh_.vertices[v])) > distance) return false;
    return true;
  }
  template <class Visit>
  void for_neighbours(std::size_t t, Visit visit) const {
    for (const auto n : neighbours_.of[t])
      if (n < FaceNeighbours::several) visit(n);
  }

  // Mean of the area vectors of a triangle and its neighbours, some times over: the noise of small triangles goes.
  void smooth_normals() {
    std::vector<Vector3d> vectors(mesh_.triangles.size());
    context_.parallel_for(vectors.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        const auto c = corners(t);
        vectors[t] = (c[1] - c[0]).cross(c[2] - c[0]);
      }
    });
    for (int round = 0; round < smoothing_rounds; ++round) {
      std::vector<Vector3d> next(vectors);
      context_.parallel_for(vectors.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) for_neighbours(t, [&](std::uint32_t n) { next[t] += vectors[n]; });
      });
      vectors.swap(next);
    }
    for (auto& v : vectors) v.normalize();
    normals_ = std::move(vectors);
  }

  // Flattest first: by the least cosine to a neighbour.
  std::vector<std::uint32_t> seeds() const {
    std::vector<float> flatness(normals_.size(), 1);
    context_.parallel_for(flatness.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t)
        for_neighbours(t, [&](std::uint32_t n) {
          flatness[t] = std::min(flatness[t], static_cast<float>(normals_[t].dot(normals_[n])));
        });
    });
    std::vector<std::uint32_t> order(flatness.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return std::tie(flatness[b], a) < std::tie(flatness[a], b); });
    return order;
  }

  void grow_all() {
    std::vector<char> tried(normals_.size(), 0);
    for (const auto seed : seeds()) {
      if (region_[seed] != unassigned || tried[seed] || normals_[seed].norm() < 0.5) continue;
      context_.check_cancelled();
      grow(seed);
      if (grown_.area >= limits_.min_area) {
        moments_.push_back(grown_);
        continue;
      }
      for (const auto t : members_) {
        region_[t] = unassigned;
        tried[t] = 1;
      }
    }
  }

  // Fills members_ and grown_ with what hangs together with the seed in one plane.
  void grow(std::uint32_t seed) {
    const auto label = static_cast<std::int32_t>(moments_.size());
    Plane plane;
    plane.normal = normals_[seed];
    plane.offset = -plane.normal.dot(corners(seed)[0] + corners(seed)[1] + corners(seed)[2]) / 3;
    members_.assign(1, seed);
    region_[seed] = label;
    grown_ = {};
    std::size_t next_fit = 16;
    for (std::size_t i = 0; i < members_.size(); ++i) {
      grown_.add(corners(members_[i]));
      if (i + 1 == next_fit) {
        plane = grown_.plane();
        next_fit += next_fit / 2;
      }
      for_neighbours(members_[i], [&](std::uint32_t n) {
        if (region_[n] != unassigned || normals_[n].dot(plane.normal) < cosine_ || !lies_in(n, plane, limits_.distance))
          return;
        region_[n] = label;
        members_.push_back(n);
      });
    }
    release_what_left(label);
  }

  // The plane has moved while the region grew: what is not in its last position goes.
  void release_what_left(std::int32_t label) {
    if (!(grown_.area > 0)) return;
    const Plane plane = grown_.plane();
    AreaMoments kept;
    for (const auto t : members_) {
      if (lies_in(t, plane, limits_.distance))
        kept.add(corners(t));
      else
        region_[t] = unassigned;
    }
    std::erase_if(members_, [&](std::uint32_t t) { return region_[t] != label; });
    grown_ = kept;
  }

  bool may_join(std::size_t t, std::int32_t region) const {
    const Plane& plane = planes_[static_cast<std::size_t>(region)];
    if (!lies_in(t, plane, limits_.distance)) return false;
    const auto c = corners(t);
    const Vector3d normal = (c[1] - c[0]).cross(c[2] - c[0]);
    return normal.dot(plane.normal) >= loose_cosine * normal.norm();
  }

  void join_neighbours() {
    std::vector<std::uint32_t> front;
    for (std::uint32_t t = 0; t < region_.size(); ++t)
      if (region_[t] != unassigned) front.push_back(t);
    for (std::size_t i = 0; i < front.size(); ++i) {
      const std::int32_t region = region_[front[i]];
      for_neighbours(front[i], [&](std::uint32_t n) {
        if (region_[n] != unassigned || !may_join(n, region)) return;
        region_[n] = region;
        front.push_back(n);
      });
    }
  }

  void smooth_borders() {
    for (int round = 0; round < border_rounds; ++round) {
      std::vector<std::int32_t> next(region_);
      context_.parallel_for(region_.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) next[t] = smoothed(t);
      });
      region_.swap(next);
    }
  }
  std::int32_t smoothed(std::size_t t) const {
    std::array<std::int32_t, 3> around{unassigned, unassigned, unassigned};
    for (std::size_t k = 0; k < 3; ++k)
      if (neighbours_.of[t][k] < FaceNeighbours::several) around[k] = region_[neighbours_.of[t][k]];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t wanted = around[k];
      if (wanted == unassigned || wanted != around[(k + 1) % 3] || wanted == region_[t]) continue;
      if (may_join(t, wanted)) return wanted;
    }
    return region_[t];
  }

  PlanarPartition by_area() {
    std::vector<AreaMoments> moments(moments_.size());
    for (std::size_t t = 0; t < region_.size(); ++t)
      if (region_[t] != unassigned) moments[static_cast<std::size_t>(region_[t])].add(corners(t));
    std::vector<std::int32_t> order(moments.size()), rank(moments.size());
    std::iota(order.begin(), order.end(), 0);
    const auto area = [&](std::int32_t r) { return moments[static_cast<std::size_t>(r)].area; };
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return area(a) > area(b); });
    PlanarPartition result;
    for (const auto r : order) {
      rank[static_cast<std::size_t>(r)] = static_cast<std::int32_t>(result.planes.size());
      if (area(r) > 0) result.planes.push_back(moments[static_cast<std::size_t>(r)].plane());
    }
    for (auto& r : region_)
      if (r != unassigned) r = rank[static_cast<std::size_t>(r)];
    result.region = std::move(region_);
    return result;
  }

  const Mesh& mesh_;
  const FaceNeighbours& neighbours_;
  const PartitionLimits& limits_;
  const Context& context_;
  double cosine_ = 0;
  std::vector<Vector3d> normals_;
  std::vector<std::int32_t> region_;
  std::vector<AreaMoments> moments_;  // of the regions
  std::vector<Plane> planes_;
  std::vector<std::uint32_t> members_;  // of the region that grows
  AreaMoments grown_;
};

}  // namespace

PlanarPartition planar_partition(const Mesh& mesh, const FaceNeighbours& neighbours, const PartitionLimits& limits,
                                 const Context& context) {
  return Growing(mesh, neighbours, limits, context).run();
}

}  // namespace atrium::baseline
