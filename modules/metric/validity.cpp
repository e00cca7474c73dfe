#include "modules/metric/validity.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "modules/metric/mesh_samples.hpp"
#include "modules/metric/self_intersections.hpp"
#include "modules/metric/welded_mesh.hpp"

namespace atrium::metric {
namespace {

constexpr double furthest = 1e60;  // beyond, signs would overflow

struct Component {
  std::size_t triangles = 0, boundary = 0;
  double area = 0, volume = 0;
  bool manifold = true, oriented = true, sound = true;  // sound: no duplicates, no meeting faces
  bool closed() const { return boundary == 0; }
  bool watertight() const { return closed() && manifold && oriented && sound; }
};

struct Edges {
  std::size_t boundary = 0, non_manifold = 0, misoriented = 0;
  double boundary_length = 0;
};

// The vertices whose faces form several fans, ascending.
std::vector<std::uint32_t> fan_vertices(const WeldedMesh& surface, const std::vector<EdgeUse>& uses) {
  // A corner is 3 · triangle + position; the corners at one vertex are joined over the edges that meet there.
  Groups corners(3 * surface.triangles.size());
  const auto corner = [&](std::uint32_t t, std::uint32_t v) {
    const auto& c = surface.triangles[t];
    return 3 * t + (c[0] == v ? 0U : c[1] == v ? 1U : 2U);
  };
  each_edge(uses, [&](const EdgeUse* first, const EdgeUse* last) {
    for (const auto* use = first + 1; use < last; ++use)
      for (const auto v : {first->low, first->high}) corners.join(corner(first->triangle, v), corner(use->triangle, v));
  });
  std::vector<std::uint32_t> fan(surface.vertices.size(), 0xffffffffU), split;
  for (std::uint32_t c = 0; c < 3 * surface.triangles.size(); ++c) {
    const auto v = surface.triangles[c / 3][c % 3], group = corners.of(c);
    if (fan[v] == 0xffffffffU) fan[v] = group;
    if (fan[v] != group) split.push_back(v);
  }
  std::sort(split.begin(), split.end());
  split.erase(std::unique(split.begin(), split.end()), split.end());
  return split;
}

struct Findings {
  Edges edges;
  std::vector<std::uint32_t> split_vertices;
  SelfIntersections intersections;
  std::vector<Component> components;  // by falling area
};

std::vector<Component> components_of(const WeldedMesh& surface, const std::vector<EdgeUse>& uses,
                                     const Findings& found) {
  Groups groups(surface.triangles.size());
  each_edge(uses, [&](const EdgeUse* first, const EdgeUse* last) {
    for (const auto* use = first + 1; use < last; ++use) groups.join(first->triangle, use->triangle);
  });
  std::vector<std::uint32_t> number(surface.triangles.size(), 0xffffffffU);
  std::vector<Component> components;
  const auto component = [&](std::uint32_t t) -> Component& {
    auto& n = number[groups.of(t)];
    if (n == 0xffffffffU) {
      n = static_cast<std::uint32_t>(components.size());
      components.emplace_back();
    }
    return components[n];
  };
  const Eigen::Vector3d about = surface.vertices.empty() ? Eigen::Vector3d::Zero() : surface.vertices.front();
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    Component& c = component(t);
    ++c.triangles;
    c.area += surface.area(t);
    const auto& [p, q, r] = surface.triangles[t];
    c.volume += (surface.vertices[p] - about).dot((surface.vertices[q] - about).cross(surface.vertices[r] - about)) / 6;
    if (surface.duplicate[t]) c.sound = false;
    if (std::any_of(surface.triangles[t].begin(), surface.triangles[t].end(), [&](std::uint32_t v) {
          return std::binary_search(found.split_vertices.begin(), found.split_vertices.end(), v);
        }))
      c.manifold = false;
  }
  for (const auto t : found.intersections.triangles) component(t).sound = false;
  each_edge(uses, [&](const EdgeUse* first, const EdgeUse* last) {
    Component& c = component(first->triangle);
    if (last - first == 1) ++c.boundary;
    if (last - first > 2) c.manifold = false;
    if (last - first == 2 && first[0].forward == first[1].forward) c.oriented = false;
  });
  std::stable_sort(components.begin(), components.end(), [](const auto& a, const auto& b) { return a.area > b.area; });
  return components;
}

Edges edges_of(const WeldedMesh& surface, const std::vector<EdgeUse>& uses) {
  Edges edges;
  each_edge(uses, [&](const EdgeUse* first, const EdgeUse* last) {
    if (last - first == 1) {
      ++edges.boundary;
      edges.boundary_length += (surface.vertices[first->low] - surface.vertices[first->high]).norm();
    }
    if (last - first > 2) ++edges.non_manifold;
    if (last - first == 2 && first[0].forward == first[1].forward) ++edges.misoriented;
  });
  return edges;
}

class Report {
 public:
  explicit Report(Metrics& metrics) : metrics_(metrics) {}
  void add(const std::string& name, double value, const char* unit = "") {
    metrics_.values.push_back({"validity." + name, value, unit});
  }
  void count(const std::string& name, std::size_t n) { add(name, static_cast<double>(n)); }
  void component(const std::string& name, const Component& c) {
    count(name + ".triangles", c.triangles);
    add(name + ".area", c.area, "m2");
    count(name + ".boundary_edges", c.boundary);
    count(name + ".closed", c.closed() ? 1 : 0);
    count(name + ".watertight", c.watertight() ? 1 : 0);
    if (c.closed() && c.oriented && c.manifold) add(name + ".volume", c.volume, "m3");
  }

 private:
  Metrics& metrics_;
};

void report_components(Report& report, const std::vector<Component>& components, std::size_t listed) {
  std::size_t closed = 0, watertight = 0;
  double area = 0, closed_area = 0;
  for (const auto& c : components) {
    closed += c.closed() ? 1 : 0;
    watertight += c.watertight() ? 1 : 0;
    area += c.area;
    if (c.closed()) closed_area += c.area;
  }
  const std::size_t all = components.size();
  report.count("components.all", all);
  report.count("components.closed", closed);
  report.count("components.watertight", watertight);
  if (area > 0) report.add("components.closed_area", closed_area / area);
  report.count("closed", all > 0 && closed == all ? 1 : 0);
  report.count("watertight", all > 0 && watertight == all ? 1 : 0);
  for (std::size_t i = 0; i < std::min(listed, all); ++i)
    report.component("component_" + std::to_string(i + 1), components[i]);
}

}  // namespace

Validity::Out Validity::run(const In& in, const Params& params, Context& context) {
  const Mesh& mesh = *in.mesh;
  check_mesh(mesh, "the mesh");
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    if (mesh.vertices[i].cwiseAbs().maxCoeff() > furthest)
      throw Error("the mesh: vertex " + std::to_string(i) + " lies beyond 1e60 m", "remove or repair it");
  const WeldedMesh surface = welded(mesh, params.tolerance, context);
  const auto uses = edge_uses(surface.triangles);
  Findings found;
  found.edges = edges_of(surface, uses);
  found.split_vertices = fan_vertices(surface, uses);
  found.intersections = self_intersections(surface.vertices, surface.triangles, params.depth, context);
  found.components = components_of(surface, uses, found);

  Out out;
  Report report(out.metrics);
  report.count("triangles", mesh.triangles.size());
  report.count("degenerate_faces", surface.degenerate);
  report.count("duplicate_faces", surface.duplicates);
  report.count("edges.boundary", found.edges.boundary);
  report.add("edges.boundary_length", found.edges.boundary_length, "m");
  report.count("edges.non_manifold", found.edges.non_manifold);
  report.count("edges.misoriented", found.edges.misoriented);
  report.count("vertices.non_manifold", found.split_vertices.size());
  report.count("self_intersections.crossing", found.intersections.crossings);
  report.count("self_intersections.deep", found.intersections.deep_crossings);
  report.count("self_intersections.overlapping", found.intersections.overlaps);
  report.count("self_intersections.touching", found.intersections.touches);
  report.count("self_intersections.through_edges", found.intersections.through_edges);
  report.count("self_intersections.faces", found.intersections.triangles.size());
  report_components(report, found.components, static_cast<std::size_t>(params.listed));
  return out;
}

}  // namespace atrium::metric
