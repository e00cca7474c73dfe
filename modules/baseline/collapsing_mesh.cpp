#include "modules/baseline/collapsing_mesh.hpp"

#include <algorithm>
#include <utility>

#include "modules/baseline/input_mesh.hpp"
#include "modules/baseline/vertex_kinds.hpp"

namespace atrium::baseline {
namespace {

using Eigen::Vector3d;

constexpr double least_cosine = 0.3;      // of a triangle's normal to what it was, or to its plane's
constexpr double least_thickness = 1e-4;  // of a triangle: twice its area over its longest side squared

}  // namespace

CollapsingMesh::CollapsingMesh(const Mesh& mesh, const PlanarPartition& partition)
    : mesh_(mesh),
      partition_(partition),
      places_(mesh.vertices),
      triangles_(mesh.triangles),
      alive_(mesh.triangles.size(), 1),
      faces_(faces_of_vertices(mesh)),
      left_(mesh.triangles.size()),
      marks_(mesh.vertices.size(), 0) {}

const std::vector<std::uint32_t>& CollapsingMesh::shared(std::uint32_t u, std::uint32_t v) {
  shared_.clear();
  for (const auto f : faces_[u])
    if (has(f, v)) shared_.push_back(f);
  return shared_;
}

bool CollapsingMesh::link_allows(std::uint32_t u, std::uint32_t v) {
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
bool CollapsingMesh::spans_thirds(std::uint32_t end, std::uint32_t u, std::uint32_t v) const {
  const std::uint32_t a = third(0, u, v), b = third(1, u, v);
  return std::any_of(faces_[end].begin(), faces_[end].end(), [&](auto f) { return has(f, a) && has(f, b); });
}
std::uint32_t CollapsingMesh::third(std::size_t k, std::uint32_t u, std::uint32_t v) const {
  const auto& c = triangles_[shared_[k]];
  return *std::find_if(c.begin(), c.end(), [&](auto w) { return w != u && w != v; });
}

bool CollapsingMesh::stays_upright(std::uint32_t u, std::uint32_t v, const Vector3d& place) {
  const Vector3d before = places_[u];
  bool good = true;
  for (const auto f : faces_[u]) {
    if (has(f, v)) continue;
    const Vector3d old = area_vector(f);
    const double thickness = thickness_of(f);
    places_[u] = place;
    good = same_side(f, old, area_vector(f)) && thickness_of(f) >= std::min(least_thickness, thickness);
    places_[u] = before;
    if (!good) break;
  }
  return good;
}
bool CollapsingMesh::same_side(std::uint32_t face, const Vector3d& old, const Vector3d& now) const {
  const double old_length = old.norm(), length = now.norm();
  if (!(old_length > 0)) return true;
  const std::int32_t region = partition_.region[face];
  if (region < 0 || !by_planes_) return now.dot(old) >= least_cosine * old_length * length;
  const Vector3d& normal = partition_.planes[static_cast<std::size_t>(region)].normal;
  const double before = normal.dot(old) / old_length;
  return normal.dot(now) >= std::min(least_cosine, before) * length;
}
double CollapsingMesh::thickness_of(std::uint32_t face) const {
  const Corners& c = triangles_[face];
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k)
    longest = std::max(longest, (places_[c[k]] - places_[c[(k + 1) % 3]]).squaredNorm());
  return longest > 0 ? area_vector(face).norm() / longest : 0;
}

void CollapsingMesh::merge(std::uint32_t u, std::uint32_t v, const Vector3d& place) {
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
}

Mesh CollapsingMesh::result() const {
  std::vector<Corners> corners;
  std::vector<std::uint32_t> sources;
  for (std::uint32_t f = 0; f < triangles_.size(); ++f) {
    if (!alive_[f]) continue;
    corners.push_back(triangles_[f]);
    sources.push_back(f);
  }
  Mesh mesh = with_columns(mesh_, std::move(corners), sources);
  mesh.primitives.clear();
  for (const auto s : sources) mesh.primitives.push_back(partition_.region[s]);
  place_used_vertices(places_, mesh_.colours, mesh);
  return mesh;
}

}  // namespace atrium::baseline
