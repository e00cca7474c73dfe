#include "modules/metric/faces.hpp"

#include <Eigen/Geometry>
#include <boost/pending/disjoint_sets.hpp>
#include <map>
#include <numeric>
#include <set>
#include <string>

#include "modules/metric/mesh_samples.hpp"

namespace atrium::metric {
namespace {

// The piece of each triangle: the least triangle that it hangs together with, over edges within one primitive.
std::vector<std::uint32_t> pieces_of(const Mesh& mesh) {
  std::vector<std::uint32_t> rank(mesh.triangles.size(), 0), parent(mesh.triangles.size());
  std::iota(parent.begin(), parent.end(), 0U);
  boost::disjoint_sets<std::uint32_t*, std::uint32_t*> sets(rank.data(), parent.data());
  std::map<std::array<std::int64_t, 3>, std::uint32_t> owners;  // primitive and edge → a triangle
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(mesh.triangles[i][k], mesh.triangles[i][(k + 1) % 3]);
      const auto [owner, added] = owners.emplace(std::array<std::int64_t, 3>{mesh.primitives[i], a, b}, i);
      if (!added) sets.union_set(owner->second, i);
    }
  for (std::uint32_t i = 0; i < parent.size(); ++i) parent[i] = sets.find_set(i);
  return parent;
}

struct Count {
  std::size_t triangles = 0;
  double area = 0;
  std::set<std::int32_t> primitives;
  std::set<std::uint32_t> pieces;
};

void report(Metrics& metrics, const std::string& name, const Count& count, bool with_primitives) {
  const auto add = [&](const char* key, double value, const char* unit) {
    metrics.values.push_back({name + "." + key, value, unit});
  };
  add("triangles", static_cast<double>(count.triangles), "");
  add("area", count.area, "m2");
  if (!with_primitives) return;
  add("primitives", static_cast<double>(count.primitives.size()), "");
  add("polygons", static_cast<double>(count.pieces.size()), "");
}

}  // namespace

Faces::Out Faces::run(const In& in) {
  const Mesh& mesh = *in.mesh;
  check_mesh(mesh, "the mesh");
  const bool with_primitives = !mesh.primitives.empty();
  const auto pieces = with_primitives ? pieces_of(mesh) : std::vector<std::uint32_t>{};
  Count total;
  std::map<SurfaceClass, Count> classes;
  std::set<std::uint32_t> vertices;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    vertices.insert({a, b, c});
    const double area = (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).norm() / 2;
    const auto count = [&](Count& to) {
      ++to.triangles;
      to.area += area;
      if (!with_primitives || mesh.primitives[i] < 0) return;
      to.primitives.insert(mesh.primitives[i]);
      to.pieces.insert(pieces[i]);
    };
    count(total);
    if (!mesh.classes.empty()) count(classes[mesh.classes[i]]);
  }
  Out out;
  report(out.metrics, "faces", total, with_primitives);
  out.metrics.values.insert(out.metrics.values.begin() + 1,
                            Metric{"faces.vertices", static_cast<double>(vertices.size()), ""});
  for (const auto& [surface, count] : classes)
    report(out.metrics, "faces." + std::string(name_of(surface)), count, with_primitives);
  return out;
}

}  // namespace atrium::metric
