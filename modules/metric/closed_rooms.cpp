#include "modules/metric/closed_rooms.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "modules/geometry/triangle_tree.hpp"
#include "modules/metric/mesh_samples.hpp"
#include "modules/metric/self_intersections.hpp"
#include "modules/metric/welded_mesh.hpp"

namespace atrium::metric {
namespace {

using V = Eigen::Vector3d;

// A closed, oriented surface.
class Volume {
 public:
  Volume(const std::vector<V>& vertices, const std::vector<Triangle>& triangles) : tree_(vertices, triangles) {
    for (const auto& t : triangles)
      for (const auto v : t) box_.extend(vertices[v]);
    for (const auto& [a, b, c] : triangles) {
      const V p = vertices[a] - box_.center(), q = vertices[b] - box_.center(), r = vertices[c] - box_.center();
      signed_ += p.dot(q.cross(r)) / 6;
    }
  }
  double size() const { return std::abs(signed_); }
  const Eigen::AlignedBox3d& box() const { return box_; }
  bool contains(const V& place) const {
    if (!box_.contains(place)) return false;
    // Along no edge of a building; from inside, the first face shows its inner side.
    const auto hit = tree_.cast(place, V(0.3713907, 0.5570861, 0.7427814));
    return hit && hit.front == (signed_ < 0);
  }

 private:
  TriangleTree tree_;
  Eigen::AlignedBox3d box_;
  double signed_ = 0;
};

// Whether a closed surface goes through itself or lies on itself; rounded coordinates cross by less than `depth`.
bool is_folded(const std::vector<V>& vertices, const std::vector<Triangle>& triangles, const Context& context) {
  constexpr double depth = 0.001;
  std::vector<Triangle> faces = triangles;
  std::erase_if(faces, [&](const Triangle& t) {
    const V &a = vertices[t[0]], &b = vertices[t[1]], &c = vertices[t[2]];
    return (b - a).cross(c - a).squaredNorm() == 0;
  });
  const auto found = self_intersections(vertices, faces, depth, context);
  return found.deep_crossings > 0 || found.overlaps > 0;
}

std::vector<Volume> shells_of(const Mesh& mesh, const V& origin, const Context& context) {
  Mesh local;
  local.vertices = vertices_about(mesh, origin);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mesh.classes.empty() || mesh.classes[t] != SurfaceClass::object) local.triangles.push_back(mesh.triangles[t]);
  const WeldedMesh surface = welded(local, 0, context);
  Groups groups(surface.triangles.size());
  const auto uses = edge_uses(surface.triangles);
  each_edge(uses, [&](const EdgeUse* first, const EdgeUse* last) {
    for (const auto* use = first + 1; use < last; ++use) groups.join(first->triangle, use->triangle);
  });
  std::map<std::uint32_t, std::pair<std::vector<Triangle>, bool>> components;  // and whether it is no shell
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t)
    components[groups.of(t)].first.push_back(surface.triangles[t]);
  each_edge(uses, [&](const EdgeUse* first, const EdgeUse* last) {
    if (last - first != 2 || first[0].forward == first[1].forward) components[groups.of(first->triangle)].second = true;
  });
  std::vector<Volume> shells;
  for (const auto& [group, component] : components)
    if (!component.second && !is_folded(surface.vertices, component.first, context))
      shells.emplace_back(surface.vertices, component.first);
  return shells;
}

struct TrueVolumes {
  std::vector<Volume> rooms;
  std::size_t open = 0;
};

// The faces of one room and the outlines of its openings, as triangles of their own.
class RoomSurface {
 public:
  void add(const V& a, const V& b, const V& c) {
    const auto first = static_cast<std::uint32_t>(vertices_.size());
    vertices_.insert(vertices_.end(), {a, b, c});
    triangles_.push_back({first, first + 1, first + 2});
    sum_ += (b - a).cross(c - a) / 2;
    area_ += (b - a).cross(c - a).norm() / 2;
  }
  void add(const std::vector<V>& ring, const V& shift, bool backwards) {
    for (std::size_t i = 2; i < ring.size(); ++i)
      add(ring[0] + shift, ring[backwards ? i : i - 1] + shift, ring[backwards ? i - 1 : i] + shift);
  }
  bool closed() const { return area_ > 0 && sum_.norm() < 1e-6 * area_; }
  Volume volume() const { return {vertices_, triangles_}; }

 private:
  std::vector<V> vertices_;
  std::vector<Triangle> triangles_;
  V sum_ = V::Zero();
  double area_ = 0;
};

TrueVolumes rooms_of(const GroundTruth& truth) {
  std::vector<RoomSurface> surfaces(truth.rooms.size());
  const auto room = [&](std::int32_t i) { return i >= 0 && i < std::ssize(surfaces) ? &surfaces[i] : nullptr; };
  const Mesh& mesh = truth.mesh;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (auto* s = room(truth.faces[static_cast<std::size_t>(mesh.primitives[t])].room))
      s->add(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
  }
  for (const auto& opening : truth.openings) {
    if (auto* s = room(opening.room_a)) s->add(opening.outline, V::Zero(), false);
    if (auto* s = room(opening.room_b))
      s->add(opening.outline, -opening.thickness * area_vector(opening.outline).normalized(), true);
  }
  TrueVolumes result;
  for (const auto& surface : surfaces) {
    if (surface.closed())
      result.rooms.push_back(surface.volume());
    else
      ++result.open;
  }
  return result;
}

// Intersection over union of a room with each shell.
std::vector<double> shares(const Volume& room, const std::vector<Volume>& shells, std::size_t samples) {
  std::vector<std::size_t> both(shells.size(), 0);
  std::size_t inside = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    // Roberts' R3 sequence: evenly spread, without randomness.
    const auto n = static_cast<double>(i) + 0.5;
    V at(n * 0.8191725133961645, n * 0.6710436067037893, n * 0.5497004779019703);
    for (auto& x : at) x -= std::floor(x);
    const V place = room.box().min() + at.cwiseProduct(room.box().sizes());
    if (!room.contains(place)) continue;
    ++inside;
    for (std::size_t s = 0; s < shells.size(); ++s) both[s] += shells[s].contains(place) ? 1 : 0;
  }
  std::vector<double> result;
  for (std::size_t s = 0; s < shells.size(); ++s) {
    const double common = inside > 0 ? room.size() * static_cast<double>(both[s]) / static_cast<double>(inside) : 0;
    result.push_back(common / (room.size() + shells[s].size() - common));
  }
  return result;
}

struct RoomOverlap {
  double share;
  std::size_t room, shell;
};

}  // namespace

ClosedRooms::Out ClosedRooms::run(const In& in, const Params& params, Context& context) {
  check_mesh(*in.mesh, "the mesh");
  const TrueVolumes truth = rooms_of(*in.truth);
  if (truth.open > 0)
    context.warn(std::to_string(truth.open) + " true rooms are not closed by their faces and openings: left out");
  if (truth.rooms.empty()) throw Error("the truth has no closed rooms", "give the faces and openings of its rooms");
  const std::vector<Volume> shells = shells_of(*in.mesh, in.truth->origin, context);

  std::vector<std::vector<double>> share(truth.rooms.size());
  context.parallel_for(
      share.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t r = begin; r < end; ++r)
          share[r] = shares(truth.rooms[r], shells, static_cast<std::size_t>(params.samples));
      },
      1);
  std::vector<RoomOverlap> pairs;
  for (std::size_t r = 0; r < share.size(); ++r)
    for (std::size_t s = 0; s < shells.size(); ++s)
      if (share[r][s] > params.min_iou) pairs.push_back({share[r][s], r, s});
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const RoomOverlap& a, const RoomOverlap& b) { return a.share > b.share; });
  std::vector<bool> room_taken(truth.rooms.size(), false), shell_taken(shells.size(), false);
  std::size_t matched = 0;
  double sum = 0;
  for (const auto& pair : pairs) {
    if (room_taken[pair.room] || shell_taken[pair.shell]) continue;
    room_taken[pair.room] = shell_taken[pair.shell] = true;
    ++matched;
    sum += pair.share;
  }
  Out out;
  const auto add = [&](const char* key, double value) {
    out.metrics.values.push_back({std::string("closed_rooms.") + key, value, ""});
  };
  add("left_out", static_cast<double>(truth.open));
  add("true", static_cast<double>(truth.rooms.size()));
  add("shells", static_cast<double>(shells.size()));
  add("matched", static_cast<double>(matched));
  add("recall", static_cast<double>(matched) / static_cast<double>(truth.rooms.size()));
  if (matched > 0) add("iou", sum / static_cast<double>(matched));
  return out;
}

}  // namespace atrium::metric
