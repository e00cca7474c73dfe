#include "modules/baseline/plane_collapse.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "modules/baseline/banded_queue.hpp"
#include "modules/baseline/collapsing_mesh.hpp"
#include "modules/baseline/quadric_error.hpp"
#include "modules/baseline/vertex_kinds.hpp"

namespace atrium::baseline {
namespace {

using Eigen::Vector3d;

constexpr double length_weight = 1e-6;    // shorter edges go first where the error is the same
constexpr double parallel_cosine = 0.98;  // planes that do not tell where their border is
constexpr std::size_t few = 1000;         // a round that collapses one in so many is the last
constexpr double round_share = 0.03;      // of the triangles, at most so many go in a round without borders

struct Candidate {
  double key;
  std::uint32_t u, v, stamp;
  friend bool operator<(const Candidate& a, const Candidate& b) {
    return a.key != b.key ? a.key < b.key : std::tie(a.u, a.v, a.stamp) < std::tie(b.u, b.v, b.stamp);
  }
};

struct Edge {
  std::uint32_t other;
  std::int32_t low, high;  // what is on its sides
};

struct Move {
  Vector3d place = Vector3d::Zero();
  double error = 0, weight = 0;
  bool keep_u = true;  // u is what stays, else v
};

class Collapse {
 public:
  Collapse(const Mesh& mesh, const FaceNeighbours& neighbours, const PlanarPartition& partition,
           const CollapseLimits& limits, const Context& context)
      : source_(mesh),
        neighbours_(neighbours),
        partition_(partition),
        limits_(limits),
        context_(context),
        mesh_(mesh, partition),
        parts_(partition.region),
        stamps_(mesh.vertices.size(), 0) {
    kinds_ = vertex_kinds(mesh, mesh_.faces(), neighbours, parts_, context);
  }

  Collapsed run() {
    project();
    set_quadrics();
    Collapsed result;
    collapse_all(1);
    result.with_borders = mesh_.left();
    if (limits_.triangles > 0 && mesh_.left() > limits_.triangles) {
      give_up_borders();
      collapse_all(round_share);
    }
    result.mesh = mesh_.result();
    result.too_far = too_far_;
    return result;
  }

 private:
  std::int32_t region(std::uint32_t face) const { return partition_.region[face]; }
  const Plane& plane(std::int32_t r) const { return partition_.planes[static_cast<std::size_t>(r)]; }
  const Vector3d& place(std::uint32_t vertex) const { return mesh_.places()[vertex]; }

  // Edges that could not go at their turn get another one in each round: what costs little may go once its neighbours
  // are gone, so a round ends before it comes to what costs much.
  void collapse_all(double share) {
    for (std::size_t done = 1; done > 0 && mesh_.left() > limits_.triangles;) {
      const auto most = static_cast<std::size_t>(std::ceil(share * static_cast<double>(mesh_.left())));
      fill_queue();
      done = drain(std::max(limits_.triangles, mesh_.left() - std::min(most, mesh_.left())));
      if (done * few < mesh_.left()) break;
    }
  }
  // From here on only the error says what a border is worth; what holds the topology stays.
  void give_up_borders() {
    mesh_.forget_planes();
    parts_.assign(parts_.size(), 0);
    kinds_ = vertex_kinds(source_, faces_of_vertices(source_), neighbours_, parts_, context_);
  }

  // --- Preparation ---

  // Onto the plane, the line or the point where the vertex's planes meet.
  void project() {
    auto& places = mesh_.places();
    context_.parallel_for(places.size(), [&](std::size_t begin, std::size_t end) {
      std::vector<std::int32_t> around;
      for (std::size_t v = begin; v < end; ++v) {
        around.clear();
        for (const auto f : mesh_.faces()[v])
          if (region(f) >= 0) around.push_back(region(f));
        std::sort(around.begin(), around.end());
        around.erase(std::unique(around.begin(), around.end()), around.end());
        QuadricError error;
        for (const auto r : around) error.add(plane(r).normal, plane(r).offset, 1);
        if (around.empty()) continue;
        const Vector3d best = error.least(places[v], 1e-3);
        if ((best - places[v]).norm() <= limits_.max_projection) places[v] = best;
      }
    });
  }

  void set_quadrics() {
    quadrics_.assign(mesh_.places().size(), {});
    borders_.assign(mesh_.places().size(), {});
    for (std::uint32_t f = 0; f < parts_.size(); ++f) {
      const Vector3d twice = mesh_.area_vector(f);
      const double length = twice.norm();
      if (!(length > 0)) continue;
      const std::int32_t r = region(f);
      const Vector3d normal = r >= 0 ? plane(r).normal : Vector3d(twice / length);
      const double offset = r >= 0 ? plane(r).offset : -normal.dot(place(mesh_.corners(f)[0]));
      for (const auto v : mesh_.corners(f)) quadrics_[v].add(normal, offset, length / 6);
      for (std::size_t k = 0; k < 3; ++k)
        if (needs_holding(f, neighbours_.of[f][k])) hold_border(f, k, normal);
    }
  }
  // Whether the planes on both sides of an edge leave open where the border is.
  bool needs_holding(std::uint32_t face, std::uint32_t other) const {
    if (other >= FaceNeighbours::several) return true;
    const std::int32_t a = region(face), b = region(other);
    if (a == b || a < 0) return false;
    return b < 0 || std::abs(plane(a).normal.dot(plane(b).normal)) > parallel_cosine;
  }
  void hold_border(std::uint32_t face, std::size_t k, const Vector3d& normal) {
    const auto from = mesh_.corners(face)[k], to = mesh_.corners(face)[(k + 1) % 3];
    const Vector3d along = place(to) - place(from);
    const Vector3d across = along.cross(normal).normalized();
    if (!across.allFinite()) return;
    const double weight = limits_.border_weight * along.squaredNorm();
    for (const auto v : {from, to}) borders_[v].add(across, -across.dot(place(from)), weight);
  }

  // --- The queue ---

  // The edges at a vertex that have one or two triangles, by the other end.
  void edges_of(std::uint32_t v) {
    edges_.clear();
    for (const auto f : mesh_.faces(v))
      for (const auto w : mesh_.corners(f))
        if (w != v) edges_.push_back({w, parts_[f], outside});
    std::sort(edges_.begin(), edges_.end(),
              [](const Edge& a, const Edge& b) { return std::tie(a.other, a.low) < std::tie(b.other, b.low); });
    std::size_t kept = 0;
    for (std::size_t i = 0, j = 0; i < edges_.size(); i = j) {
      for (j = i; j < edges_.size() && edges_[j].other == edges_[i].other;) ++j;
      if (j - i <= 2)
        edges_[kept++] = edge_between(edges_[i].other, edges_[i].low, j - i == 2 ? edges_[i + 1].low : outside);
    }
    edges_.resize(kept);
  }
  static Edge edge_between(std::uint32_t other, std::int32_t one, std::int32_t two) {
    return {other, std::min(one, two), std::max(one, two)};
  }

  bool may_move(std::uint32_t v, const Edge& edge) const {
    return !kinds_[v].fixed && kinds_[v].low == edge.low && kinds_[v].high == edge.high;
  }

  bool find_move(std::uint32_t u, const Edge& edge, Move& move) {
    const std::uint32_t v = edge.other;
    const bool moves_u = may_move(u, edge), moves_v = may_move(v, edge);
    if (!moves_u && !moves_v) return false;
    QuadricError surface = quadrics_[u], border = borders_[u];
    surface += quadrics_[v];
    border += borders_[v];
    QuadricError sum = surface;
    if (border.weight > 0) sum += border;
    move.keep_u = !moves_u || (moves_v && u < v);
    move.place = moves_u && moves_v ? free_place(sum, u, v) : place(moves_u ? v : u);
    move.error = sum.at(move.place);
    move.weight = sum.weight;
    const bool near = is_near(surface, move.place) && is_near(border, move.place);
    too_far_ = too_far_ || !near;
    return near;
  }
  // Each by itself: a large surface does not make up for a border that is cut short.
  bool is_near(const QuadricError& error, const Vector3d& place) const {
    return limits_.max_error <= 0 || error.at(place) <= limits_.max_error * limits_.max_error * error.weight;
  }
  Vector3d free_place(const QuadricError& sum, std::uint32_t u, std::uint32_t v) const {
    const Vector3d middle = (place(u) + place(v)) / 2;
    Vector3d best = sum.least(middle, 1e-6);
    if ((best - middle).norm() <= (place(u) - place(v)).norm()) return best;
    best = middle;
    for (const auto& p : {place(u), place(v)})
      if (sum.at(p) < sum.at(best)) best = p;
    return best;
  }

  void push(std::uint32_t u, const Edge& edge) {
    Move move;
    if (!find_move(u, edge, move)) return;
    const double length = (place(u) - place(edge.other)).squaredNorm();
    const auto [low, high] = std::minmax(u, edge.other);
    queue_.push({move.error + length_weight * move.weight * length, low, high, stamps_[u] + stamps_[edge.other]});
  }
  void fill_queue() {
    queue_.clear();
    too_far_ = false;
    for (std::uint32_t v = 0; v < stamps_.size(); ++v) {
      edges_of(v);
      for (const auto& edge : edges_)
        if (v < edge.other) push(v, edge);
    }
  }

  std::size_t drain(std::size_t triangles) {
    std::size_t done = 0, seen = 0;
    const auto is_current = [&](const Candidate& c) {
      return c.stamp == stamps_[c.u] + stamps_[c.v] && !mesh_.faces(c.u).empty() && !mesh_.faces(c.v).empty();
    };
    Candidate top{};
    while (mesh_.left() > triangles && queue_.pop(top, is_current)) {
      if (++seen % 4096 == 0) context_.check_cancelled();
      done += try_edge(top.u, top.v) ? 1 : 0;
    }
    return done;
  }

  // An edge whose best place would turn a triangle over may still go to one of its ends.
  bool find_upright(std::uint32_t u, const Edge& edge, Move& move) {
    const std::uint32_t v = edge.other;
    const auto upright = [&](const Vector3d& place) {
      return mesh_.stays_upright(u, v, place) && mesh_.stays_upright(v, u, place);
    };
    if (upright(move.place)) return true;
    if (!may_move(u, edge) || !may_move(v, edge)) return false;
    QuadricError surface = quadrics_[u], border = borders_[u];
    surface += quadrics_[v];
    border += borders_[v];
    for (const auto end : {u, v}) {
      move.place = place(end);
      if (is_near(surface, move.place) && is_near(border, move.place) && upright(move.place)) return true;
    }
    return false;
  }

  bool try_edge(std::uint32_t u, std::uint32_t v) {
    const auto& shared = mesh_.shared(u, v);
    if (shared.empty() || shared.size() > 2) return false;
    const Edge edge = edge_between(v, parts_[shared[0]], shared.size() == 2 ? parts_[shared[1]] : outside);
    Move move;
    if (!find_move(u, edge, move) || !mesh_.link_allows(u, v) || !find_upright(u, edge, move)) return false;
    if (move.keep_u) std::swap(u, v);
    mesh_.merge(u, v, move.place);
    quadrics_[v] += quadrics_[u];
    borders_[v] += borders_[u];
    ++stamps_[v];
    ++stamps_[u];
    edges_of(v);
    for (const auto& e : edges_) push(v, e);
    return true;
  }

  const Mesh& source_;
  const FaceNeighbours& neighbours_;
  const PlanarPartition& partition_;
  const CollapseLimits& limits_;
  const Context& context_;
  CollapsingMesh mesh_;
  std::vector<std::int32_t> parts_;     // between which borders are kept; per triangle
  std::vector<VertexKind> kinds_;       // never change while the parts do not: collapses keep the partition
  std::vector<QuadricError> quadrics_;  // to the surface
  std::vector<QuadricError> borders_;   // to the planes that hold borders
  std::vector<std::uint32_t> stamps_;   // how often a vertex changed
  BandedQueue<Candidate> queue_;
  bool too_far_ = false;     // whether max_error kept an edge, this time round
  std::vector<Edge> edges_;  // of the vertex at hand
};

}  // namespace

Collapsed collapsed_by_planes(const Mesh& mesh, const FaceNeighbours& neighbours, const PlanarPartition& partition,
                              const CollapseLimits& limits, const Context& context) {
  return Collapse(mesh, neighbours, partition, limits, context).run();
}

}  // namespace atrium::baseline
