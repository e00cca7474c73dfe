#include "modules/baseline/plane_collapse.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include "modules/baseline/input_mesh.hpp"
#include "modules/baseline/quadric_error.hpp"
#include "modules/baseline/vertex_kinds.hpp"

namespace atrium::baseline {
namespace {

using Eigen::Vector3d;
using Corners = std::array<std::uint32_t, 3>;

constexpr double least_cosine = 0.3;      // of a triangle's normal to what it was, or to its plane's
constexpr double least_thickness = 1e-4;  // of a triangle: twice its area over its longest side squared
constexpr double length_weight = 1e-6;    // shorter edges go first where the error is the same
constexpr double parallel_cosine = 0.98;  // planes that do not tell where their border is

struct Candidate {
  double key;
  std::uint32_t u, v, stamp;
  friend bool operator<(const Candidate& a, const Candidate& b) {  // the queue's top is the greatest
    return std::tie(b.key, b.u, b.v) < std::tie(a.key, a.u, a.v);
  }
};

struct Edge {
  std::uint32_t other;
  std::int32_t low, high;  // regions on its sides
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
      : mesh_(mesh),
        neighbours_(neighbours),
        partition_(partition),
        limits_(limits),
        context_(context),
        places_(mesh.vertices),
        triangles_(mesh.triangles),
        alive_(mesh.triangles.size(), 1),
        faces_(faces_of_vertices(mesh)),
        stamps_(mesh.vertices.size(), 0),
        marks_(mesh.vertices.size(), 0) {
    kinds_ = vertex_kinds(mesh, faces_, neighbours, partition.region, context);
    left_ = triangles_.size();
  }

  Mesh run() {
    project();
    set_quadrics();
    for (std::size_t done = 1; done > 0 && left_ > limits_.triangles;) {
      fill_queue();
      done = drain();
      if (done * 1000 < left_) break;
    }
    return result();
  }
  bool too_far() const { return too_far_; }

 private:
  std::int32_t region(std::uint32_t face) const { return partition_.region[face]; }
  const Plane& plane(std::int32_t r) const { return partition_.planes[static_cast<std::size_t>(r)]; }
  Vector3d area_vector(const Corners& c) const {
    return (places_[c[1]] - places_[c[0]]).cross(places_[c[2]] - places_[c[0]]);
  }

  // --- Preparation ---

  // Onto the plane, the line or the point where the vertex's planes meet.
  void project() {
    context_.parallel_for(places_.size(), [&](std::size_t begin, std::size_t end) {
      std::vector<std::int32_t> around;
      for (std::size_t v = begin; v < end; ++v) {
        around.clear();
        for (const auto f : faces_[v])
          if (region(f) >= 0) around.push_back(region(f));
        std::sort(around.begin(), around.end());
        around.erase(std::unique(around.begin(), around.end()), around.end());
        QuadricError error;
        for (const auto r : around) error.add(plane(r).normal, plane(r).offset, 1);
        if (around.empty()) continue;
        const Vector3d place = error.least(places_[v], 1e-3);
        if ((place - places_[v]).norm() <= limits_.max_projection) places_[v] = place;
      }
    });
  }

  void set_quadrics() {
    quadrics_.assign(places_.size(), {});
    borders_.assign(places_.size(), {});
    for (std::uint32_t f = 0; f < triangles_.size(); ++f) {
      const Vector3d twice = area_vector(triangles_[f]);
      const double length = twice.norm();
      if (!(length > 0)) continue;
      const std::int32_t r = region(f);
      const Vector3d normal = r >= 0 ? plane(r).normal : Vector3d(twice / length);
      const double offset = r >= 0 ? plane(r).offset : -normal.dot(places_[triangles_[f][0]]);
      for (const auto v : triangles_[f]) quadrics_[v].add(normal, offset, length / 6);
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
    const auto from = triangles_[face][k], to = triangles_[face][(k + 1) % 3];
    const Vector3d along = places_[to] - places_[from];
    const Vector3d across = along.cross(normal).normalized();
    if (!across.allFinite()) return;
    const double weight = limits_.border_weight * along.squaredNorm();
    for (const auto v : {from, to}) borders_[v].add(across, -across.dot(places_[from]), weight);
  }

  // --- The queue ---

  // The edges at a vertex that have one or two triangles, by the other end.
  void edges_of(std::uint32_t v) {
    edges_.clear();
    for (const auto f : faces_[v])
      for (const auto w : triangles_[f])
        if (w != v) edges_.push_back({w, region(f), outside});
    std::stable_sort(edges_.begin(), edges_.end(), [](const Edge& a, const Edge& b) { return a.other < b.other; });
    std::size_t kept = 0;
    for (std::size_t i = 0, j = 0; i < edges_.size(); i = j) {
      for (j = i; j < edges_.size() && edges_[j].other == edges_[i].other;) ++j;
      if (j - i > 2) continue;
      Edge edge = edges_[i];
      edge.high = j - i == 2 ? edges_[i + 1].low : outside;
      if (edge.low > edge.high) std::swap(edge.low, edge.high);
      edges_[kept++] = edge;
    }
    edges_.resize(kept);
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
    sum += border;
    move.keep_u = !moves_u || (moves_v && u < v);
    move.place = moves_u && moves_v ? free_place(sum, u, v) : places_[moves_u ? v : u];
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
    const Vector3d middle = (places_[u] + places_[v]) / 2;
    Vector3d best = sum.least(middle, 1e-6);
    if ((best - middle).norm() <= (places_[u] - places_[v]).norm()) return best;
    Vector3d place = middle;
    for (const auto& p : {places_[u], places_[v]})
      if (sum.at(p) < sum.at(place)) place = p;
    return place;
  }

  void push(std::uint32_t u, const Edge& edge) {
    Move move;
    if (!find_move(u, edge, move)) return;
    const double length = (places_[u] - places_[edge.other]).squaredNorm();
    const auto [low, high] = std::minmax(u, edge.other);
    queue_.push({move.error + length_weight * move.weight * length, low, high, stamps_[u] + stamps_[edge.other]});
  }
  void fill_queue() {
    queue_ = {};
    too_far_ = false;
    for (std::uint32_t v = 0; v < places_.size(); ++v) {
      edges_of(v);
      for (const auto& edge : edges_)
        if (v < edge.other) push(v, edge);
    }
  }

  std::size_t drain() {
    std::size_t done = 0, seen = 0;
    while (!queue_.empty() && left_ > limits_.triangles) {
      const Candidate top = queue_.top();
      queue_.pop();
      if (++seen % 4096 == 0) context_.check_cancelled();
      if (top.stamp != stamps_[top.u] + stamps_[top.v] || faces_[top.u].empty() || faces_[top.v].empty()) continue;
      done += try_edge(top.u, top.v) ? 1 : 0;
    }
    return done;
  }

  // --- One edge ---

  bool try_edge(std::uint32_t u, std::uint32_t v) {
    shared_.clear();
    for (const auto f : faces_[u])
      if (has(f, v)) shared_.push_back(f);
    if (shared_.empty() || shared_.size() > 2) return false;
    Edge edge{v, region(shared_[0]), shared_.size() == 2 ? region(shared_[1]) : outside};
    if (edge.low > edge.high) std::swap(edge.low, edge.high);
    Move move;
    if (!find_move(u, edge, move) || !link_allows(u, v)) return false;
    if (!stays_upright(u, v, move.place) || !stays_upright(v, u, move.place)) return false;
    if (move.keep_u) std::swap(u, v);
    merge(u, v, move.place);
    return true;
  }
  bool has(std::uint32_t face, std::uint32_t v) const {
    const auto& c = triangles_[face];
    return c[0] == v || c[1] == v || c[2] == v;
  }

  // Dey, Edelsbrunner, Guha and Nekhayev 1999: the ends have no neighbours in common but the triangles' third corners.
  bool link_allows(std::uint32_t u, std::uint32_t v) {
    ++mark_;
    for (const auto f : faces_[u])
      for (const auto w : triangles_[f]) marks_[w] = mark_;
    marks_[u] = marks_[v] = 0;
    std::size_t common = 0;
    for (const auto f : faces_[v])
      for (const auto w : triangles_[f])
        if (marks_[w] == mark_) {
          marks_[w] = 0;
          ++common;
        }
    if (common != shared_.size()) return false;
    if (faces_[u].size() + faces_[v].size() <= 2 * shared_.size()) return false;      // a triangle by itself
    return shared_.size() == 1 || !(spans_thirds(u, u, v) && spans_thirds(v, u, v));  // a tetrahedron
  }
  // Whether a triangle of `end` has the third corners of both of the edge's triangles: it would become a double.
  bool spans_thirds(std::uint32_t end, std::uint32_t u, std::uint32_t v) const {
    const std::uint32_t a = third(0, u, v), b = third(1, u, v);
    return std::any_of(faces_[end].begin(), faces_[end].end(), [&](auto f) { return has(f, a) && has(f, b); });
  }
  std::uint32_t third(std::size_t k, std::uint32_t u, std::uint32_t v) const {
    const auto& c = triangles_[shared_[k]];
    return *std::find_if(c.begin(), c.end(), [&](auto w) { return w != u && w != v; });
  }

  // Whether u's triangles without v keep their side and some thickness when u goes to `place`.
  bool stays_upright(std::uint32_t u, std::uint32_t v, const Vector3d& place) {
    const Vector3d before = places_[u];
    bool good = true;
    for (const auto f : faces_[u]) {
      if (has(f, v)) continue;
      const Vector3d old = area_vector(triangles_[f]);
      const double thickness = thickness_of(triangles_[f]);
      places_[u] = place;
      good = same_side(f, old, area_vector(triangles_[f])) &&
             thickness_of(triangles_[f]) >= std::min(least_thickness, thickness);
      places_[u] = before;
      if (!good) break;
    }
    return good;
  }
  bool same_side(std::uint32_t face, const Vector3d& old, const Vector3d& now) const {
    const double old_length = old.norm(), length = now.norm();
    if (!(old_length > 0)) return true;
    if (region(face) < 0) return now.dot(old) >= least_cosine * old_length * length;
    const Vector3d& normal = plane(region(face)).normal;
    const double before = normal.dot(old) / old_length;
    return normal.dot(now) >= std::min(least_cosine, before) * length;
  }
  double thickness_of(const Corners& c) const {
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k)
      longest = std::max(longest, (places_[c[k]] - places_[c[(k + 1) % 3]]).squaredNorm());
    return longest > 0 ? area_vector(c).norm() / longest : 0;
  }

  // u goes into v.
  void merge(std::uint32_t u, std::uint32_t v, const Vector3d& place) {
    for (const auto f : shared_) {
      alive_[f] = 0;
      --left_;
      for (const auto w : triangles_[f])
        if (w != u && w != v) std::erase(faces_[w], f);
    }
    std::erase_if(faces_[v], [&](std::uint32_t f) { return !alive_[f]; });
    for (const auto f : faces_[u]) {
      if (!alive_[f]) continue;
      for (auto& w : triangles_[f])
        if (w == u) w = v;
      faces_[v].push_back(f);
    }
    faces_[u] = {};
    places_[v] = place;
    quadrics_[v] += quadrics_[u];
    borders_[v] += borders_[u];
    ++stamps_[v];
    ++stamps_[u];
    edges_of(v);
    for (const auto& edge : edges_) push(v, edge);
  }

  Mesh result() const {
    std::vector<Corners> corners;
    std::vector<std::uint32_t> sources;
    for (std::uint32_t f = 0; f < triangles_.size(); ++f) {
      if (!alive_[f]) continue;
      corners.push_back(triangles_[f]);
      sources.push_back(f);
    }
    Mesh mesh = with_columns(mesh_, std::move(corners), sources);
    mesh.primitives.clear();
    for (const auto s : sources) mesh.primitives.push_back(region(s));
    place_used_vertices(places_, mesh_.colours, mesh);
    return mesh;
  }

  const Mesh& mesh_;
  const FaceNeighbours& neighbours_;
  const PlanarPartition& partition_;
  const CollapseLimits& limits_;
  const Context& context_;
  std::vector<Vector3d> places_;
  std::vector<Corners> triangles_;
  std::vector<char> alive_;
  std::vector<std::vector<std::uint32_t>> faces_;  // of each vertex; none: it is gone
  std::vector<VertexKind> kinds_;                  // never change: collapses keep the partition
  std::vector<QuadricError> quadrics_;             // to the surface
  std::vector<QuadricError> borders_;              // to the planes that hold borders
  std::vector<std::uint32_t> stamps_;              // how often a vertex changed
  std::priority_queue<Candidate> queue_;
  std::size_t left_ = 0;
  bool too_far_ = false;  // whether max_error kept an edge, this time round
  std::vector<std::uint32_t> marks_;
  std::uint32_t mark_ = 0;
  std::vector<std::uint32_t> shared_;  // triangles of the edge at hand
  std::vector<Edge> edges_;            // of the vertex at hand
};

}  // namespace

Mesh collapsed_by_planes(const Mesh& mesh, const FaceNeighbours& neighbours, const PlanarPartition& partition,
                         const CollapseLimits& limits, const Context& context, bool& too_far) {
  Collapse collapse(mesh, neighbours, partition, limits, context);
  Mesh result = collapse.run();
  too_far = collapse.too_far();
  return result;
}

}  // namespace atrium::baseline
