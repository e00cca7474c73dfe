#include "modules/metric/structure.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "modules/geometry/triangle_tree.hpp"
#include "modules/metric/mesh_samples.hpp"

namespace atrium::metric {
namespace {

constexpr std::array<SurfaceClass, 3> structural{SurfaceClass::wall, SurfaceClass::floor, SurfaceClass::ceiling};

// The triangles of one mesh that count, about the truth's origin.
struct Side {
  Mesh mesh;  // vertices, triangles and classes only
  std::vector<Eigen::Vector3d> normals;
  TriangleTree tree;
  MeshSamples samples;

  bool has_classes() const { return !mesh.classes.empty(); }
};

Side side_of(const Mesh& mesh, const Eigen::Vector3d& origin, const Structure::Params& params, const Context& context,
             const std::string& what) {
  check_mesh(mesh, what);
  Side side;
  side.mesh.vertices = vertices_about(mesh, origin);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!mesh.classes.empty() && mesh.classes[i] == SurfaceClass::object) continue;
    const auto& [a, b, c] = mesh.triangles[i];
    const Eigen::Vector3d normal = (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
    if (!(normal.norm() > 0)) continue;
    side.mesh.triangles.push_back(mesh.triangles[i]);
    if (!mesh.classes.empty()) side.mesh.classes.push_back(mesh.classes[i]);
    side.normals.push_back(normal.normalized());
  }
  side.tree = TriangleTree(side.mesh.vertices, side.mesh.triangles);
  side.samples = sample_mesh(side.mesh, params.spacing, static_cast<double>(params.max_samples));
  if (side.samples.spacing > params.spacing)
    context.warn(what + " has " + std::to_string(side.samples.area) + " m2: its samples stand " +
                 std::to_string(side.samples.spacing) + " m apart, as max_samples wants it");
  return side;
}

// Distance of each sample of `from` to matching surface of `to`; infinity beyond `reach`. With `same_class`, only
// surface of the sample's class matches.
std::vector<double> distances(const Side& from, const Side& to, bool same_class, double reach,
                              const Structure::Params& params, const Context& context) {
  const double least_cosine = std::cos(params.max_angle * std::numbers::pi / 180) - 1e-12;
  std::vector<double> result(from.samples.points.size(), std::numeric_limits<double>::infinity());
  const double limit = reach * reach * (1 + 1e-9);
  context.parallel_for(
      result.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const auto own = from.samples.triangles[i];
          const auto found = to.tree.nearest_of(from.samples.points[i], limit, [&](std::uint32_t t) {
            const double cosine = from.normals[own].dot(to.normals[t]);
            return (params.oriented ? cosine : std::abs(cosine)) >= least_cosine &&
                   (!same_class || from.mesh.classes[own] == to.mesh.classes[t]);
          });
          if (found) result[i] = std::sqrt(found.squared_distance);
        }
      },
      1024);
  return result;
}

using Filter = std::optional<SurfaceClass>;

bool counts(const Side& side, std::size_t sample, const Filter& surface) {
  return !surface || side.mesh.classes[side.samples.triangles[sample]] == *surface;
}

double area_of(const Side& side, const Filter& surface) {
  double sum = 0;
  for (std::size_t i = 0; i < side.samples.points.size(); ++i)
    if (counts(side, i, surface)) sum += side.samples.weights[i];
  return sum;
}

double area_within(const Side& side, const std::vector<double>& distance, const Filter& surface, double buffer) {
  double sum = 0;
  for (std::size_t i = 0; i < distance.size(); ++i)
    if (distance[i] <= buffer && counts(side, i, surface)) sum += side.samples.weights[i];
  return sum;
}

/// Median by area of the distances that are within the buffer; none if there are none.
std::optional<double> median_within(const Side& side, const std::vector<double>& distance, const Filter& surface,
                                    double buffer) {
  std::vector<std::pair<double, double>> inside;  // distance, weight
  double total = 0, passed = 0;
  for (std::size_t i = 0; i < distance.size(); ++i) {
    if (!(distance[i] <= buffer) || !counts(side, i, surface)) continue;
    inside.emplace_back(distance[i], side.samples.weights[i]);
    total += side.samples.weights[i];
  }
  std::sort(inside.begin(), inside.end());
  for (const auto& [d, weight] : inside) {
    passed += weight;
    if (passed >= total / 2) return d;
  }
  return {};
}

std::string name_of_buffer(double buffer) {
  const double millimetres = std::round(buffer * 1000);
  if (millimetres < 1 || std::abs(buffer * 1000 - millimetres) > 1e-6)
    throw Error("a buffer of " + std::to_string(buffer) + " m", "buffers are whole millimetres, from 1 mm");
  return "b" + std::to_string(static_cast<long>(millimetres)) + "mm";
}

struct Comparison {
  const Side &truth, &mesh;
  std::vector<double> from_truth, from_mesh;
};

void report(Metrics& metrics, const std::string& group, const Comparison& c, const Filter& surface,
            const std::vector<double>& buffers) {
  const double true_area = area_of(c.truth, surface), area = area_of(c.mesh, surface);
  if (!(true_area > 0) && !(area > 0)) return;
  metrics.values.push_back({group + ".area.true", true_area, "m2"});
  metrics.values.push_back({group + ".area.reconstructed", area, "m2"});
  for (const double buffer : buffers) {
    const std::string name = group + "." + name_of_buffer(buffer);
    const auto share = [&](const char* key, double part, double whole) {
      if (whole > 0) metrics.values.push_back({name + "." + key, std::min(1.0, part / whole), ""});
    };
    share("completeness", area_within(c.truth, c.from_truth, surface, buffer), true_area);
    share("correctness", area_within(c.mesh, c.from_mesh, surface, buffer), area);
    if (const auto median = median_within(c.mesh, c.from_mesh, surface, buffer))
      metrics.values.push_back({name + ".accuracy", *median, "m"});
  }
}

}  // namespace

Structure::Out Structure::run(const In& in, const Params& params, Context& context) {
  if (static_cast<bool>(in.truth) == static_cast<bool>(in.truth_mesh))
    throw Error(in.truth ? "both truth and truth_mesh are wired" : "neither truth nor truth_mesh is wired",
                "wire one of them: truth of a simulated scene, or truth_mesh read from a file");
  if (params.buffers.empty()) throw Error("no buffers", "give at least one distance");
  for (const double b : params.buffers) name_of_buffer(b);
  const Mesh& given = in.truth ? in.truth->mesh : *in.truth_mesh;
  const Side truth = side_of(given, given.origin, params, context, "the truth");
  const Side mesh = side_of(*in.mesh, given.origin, params, context, "the mesh");
  if (!(truth.samples.area > 0)) throw Error("the truth has no walls, floors or ceilings: nothing to compare with");

  const double reach = *std::max_element(params.buffers.begin(), params.buffers.end());
  const auto compare = [&](bool same_class) {
    return Comparison{truth, mesh, distances(truth, mesh, same_class, reach, params, context),
                      distances(mesh, truth, same_class, reach, params, context)};
  };
  Out out;
  report(out.metrics, "structure", compare(false), {}, params.buffers);
  if (!truth.has_classes() || !mesh.has_classes()) return out;
  const Comparison by_class = compare(true);
  for (const auto surface : structural)
    report(out.metrics, "structure." + std::string(name_of(surface)), by_class, surface, params.buffers);
  return out;
}

}  // namespace atrium::metric
