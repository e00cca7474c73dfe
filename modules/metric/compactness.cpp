#include "modules/metric/compactness.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <set>
#include <string>

#include "modules/metric/fewest_corners.hpp"
#include "modules/metric/mesh_samples.hpp"
#include "modules/metric/welded_mesh.hpp"

namespace atrium::metric {
namespace {

constexpr double flat_cosine = 1 - 1.5230870e-6;  // of 0.1°
constexpr double flat_distance = 0.001;           // metres

std::size_t count_polygons(const Mesh& mesh, const std::vector<bool>& counts, const Context& context) {
  const WeldedMesh surface = welded(mesh, 0, context);
  const auto normal = [&](std::uint32_t t) {
    const auto& [a, b, c] = surface.triangles[t];
    return Eigen::Vector3d(
        (surface.vertices[b] - surface.vertices[a]).cross(surface.vertices[c] - surface.vertices[a]).normalized());
  };
  const auto coplanar = [&](std::uint32_t s, std::uint32_t t) {
    const Eigen::Vector3d n = normal(s);
    if (n.dot(normal(t)) < flat_cosine) return false;
    for (const auto v : surface.triangles[t])
      if (std::abs(n.dot(surface.vertices[v] - surface.vertices[surface.triangles[s][0]])) > flat_distance)
        return false;
    return true;
  };
  const auto same_primitive = [&](std::uint32_t s, std::uint32_t t) {
    return mesh.primitives.empty() || mesh.primitives[surface.source[s]] == mesh.primitives[surface.source[t]];
  };
  Groups groups(surface.triangles.size());
  each_edge(edge_uses(surface.triangles), [&](const EdgeUse* first, const EdgeUse* last) {
    for (const auto* a = first; a < last; ++a)
      for (const auto* b = a + 1; b < last; ++b)
        if (counts[surface.source[a->triangle]] && counts[surface.source[b->triangle]] &&
            same_primitive(a->triangle, b->triangle) && coplanar(a->triangle, b->triangle))
          groups.join(a->triangle, b->triangle);
  });
  std::set<std::uint32_t> polygons;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t)
    if (counts[surface.source[t]]) polygons.insert(groups.of(t));
  return polygons.size();
}

void check_outline(const TrueRoom& room) {
  const std::string name = "the outline of the true room '" + room.name + "'";
  if (room.outline.size() < 3)
    throw Error(name + " has " + std::to_string(room.outline.size()) + " corners", "three are the least");
  for (const auto& p : room.outline)
    if (!p.allFinite()) throw Error(name + " has a corner that is not finite");
}

}  // namespace

Compactness::Out Compactness::run(const In& in, const Params& params, Context& context) {
  const Mesh& mesh = *in.mesh;
  check_mesh(mesh, "the mesh");
  if (in.truth && in.truth->rooms.empty()) throw Error("the truth has no rooms: the least that they need is not known");
  std::vector<bool> counts(mesh.triangles.size(), true);
  std::size_t triangles = 0;
  for (std::size_t t = 0; t < counts.size(); ++t) {
    counts[t] = mesh.classes.empty() || mesh.classes[t] != SurfaceClass::object;
    triangles += counts[t] ? 1 : 0;
  }
  Out out;
  const auto add = [&](const char* key, double value) {
    out.metrics.values.push_back({std::string("compactness.") + key, value, ""});
  };
  add("triangles", static_cast<double>(triangles));
  add("polygons", static_cast<double>(count_polygons(mesh, counts, context)));
  if (!in.truth) return out;
  std::size_t corners = 0, least = 0;
  for (const auto& room : in.truth->rooms) {
    check_outline(room);
    const std::size_t n = fewest_corners(room.outline, params.sagitta);
    corners += n;
    least += 4 * n - 4;
  }
  add("corners", static_cast<double>(corners));
  add("least_triangles", static_cast<double>(least));
  add("ratio", static_cast<double>(triangles) / static_cast<double>(least));
  return out;
}

}  // namespace atrium::metric
