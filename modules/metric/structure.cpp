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

// A wall that stands 3 cm off lies within 3 cm, however its coordinates were rounded.
constexpr double rounding = 1e-9;  // metres
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
  const double limit = (reach + rounding) * (reach + rounding) * (1 + 1e-9);
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

// How much of one side's area (of one class, if asked for) lies within any distance of the other.
class Profile {
 public:
  Profile(const Side& side, const std::vector<double>& distance, const Filter& surface) {
    std::vector<std::pair<double, double>> found;  // distance, weight
    for (std::size_t i = 0; i < distance.size(); ++i) {
      if (surface && side.mesh.classes[side.samples.triangles[i]] != *surface) continue;
      if (!(distance[i] < std::numeric_limits<double>::infinity()))
        area_ += side.samples.weights[i];
      else
        found.emplace_back(distance[i], side.samples.weights[i]);
    }
    std::sort(found.begin(), found.end());
    double passed = 0;
    for (const auto& [d, weight] : found) {
      distances_.push_back(d);
      passed_.push_back(passed += weight);
    }
    area_ += passed;  // the same sum, so that a share of all is exactly 1
  }
  double area() const { return area_; }
  double within(double buffer) const {
    const auto n = count_within(buffer);
    return n > 0 ? passed_[n - 1] : 0;
  }
  /// Median by area of the distances that are within the buffer; none if there are none.
  std::optional<double> median_within(double buffer) const {
    const auto n = count_within(buffer);
    if (n == 0) return {};
    const auto half =
        std::lower_bound(passed_.begin(), passed_.begin() + static_cast<std::ptrdiff_t>(n), passed_[n - 1] / 2);
    return distances_[static_cast<std::size_t>(half - passed_.begin())];
  }

 private:
  std::size_t count_within(double buffer) const {
    return static_cast<std::size_t>(std::upper_bound(distances_.begin(), distances_.end(), buffer + rounding) -
                                    distances_.begin());
  }
  std::vector<double> distances_, passed_;
  double area_ = 0;
};

std::string name_of_buffer(double buffer, std::size_t digits) {
  const double millimetres = std::round(buffer * 1000);
  if (millimetres < 1 || std::abs(buffer * 1000 - millimetres) > 1e-6)
    throw Error("a buffer of " + std::to_string(buffer) + " m", "buffers are whole millimetres, from 1 mm");
  const std::string number = std::to_string(static_cast<long>(millimetres));
  return "b" + std::string(digits > number.size() ? digits - number.size() : 0, '0') + number + "mm";
}

struct SurfaceComparison {
  const Side &truth, &mesh;
  std::vector<double> from_truth, from_mesh;
};

void report_buffers(Metrics& metrics, const std::string& group, const Profile& truth, const Profile& mesh,
                    const std::vector<double>& buffers, std::size_t digits) {
  for (const double buffer : buffers) {
    const std::string name = group + "." + name_of_buffer(buffer, digits);
    const auto share = [&](const char* key, const Profile& profile) {
      if (profile.area() > 0)
        metrics.values.push_back({name + "." + key, std::min(1.0, profile.within(buffer) / profile.area()), ""});
    };
    share("completeness", truth);
    share("correctness", mesh);
    if (const auto median = mesh.median_within(buffer)) metrics.values.push_back({name + ".accuracy", *median, "m"});
  }
}

struct Buffers {
  std::vector<double> asked, curve;
};

void report(Structure::Out& out, const SurfaceComparison& c, const Filter& surface, const Buffers& buffers) {
  const Profile truth(c.truth, c.from_truth, surface), mesh(c.mesh, c.from_mesh, surface);
  if (!(truth.area() > 0) && !(mesh.area() > 0)) return;
  const std::string own = surface ? std::string(name_of(*surface)) : "";
  const std::string group = surface ? "structure." + own : "structure";
  out.metrics.values.push_back({group + ".area.true", truth.area(), "m2"});
  out.metrics.values.push_back({group + ".area.reconstructed", mesh.area(), "m2"});
  report_buffers(out.metrics, group, truth, mesh, buffers.asked, 0);
  report_buffers(out.curve, "structure_curve." + (surface ? own : "total"), truth, mesh, buffers.curve, 3);
}

Buffers buffers_of(const Structure::Params& params) {
  if (params.buffers.empty()) throw Error("no buffers", "give at least one distance");
  Buffers buffers{params.buffers, {}};
  const auto steps = static_cast<std::size_t>(std::floor(params.curve_reach / params.curve_step + 1e-9));
  for (std::size_t i = 1; i <= steps; ++i) buffers.curve.push_back(params.curve_step * static_cast<double>(i));
  for (const auto* list : {&buffers.asked, &buffers.curve})
    for (const double b : *list) name_of_buffer(b, 0);
  return buffers;
}

}  // namespace

Structure::Out Structure::run(const In& in, const Params& params, Context& context) {
  if (static_cast<bool>(in.truth) == static_cast<bool>(in.truth_mesh))
    throw Error(in.truth ? "both truth and truth_mesh are wired" : "neither truth nor truth_mesh is wired",
                "wire one of them: truth of a simulated scene, or truth_mesh read from a file");
  const Buffers buffers = buffers_of(params);
  const Mesh& given = in.truth ? in.truth->mesh : *in.truth_mesh;
  const Side truth = side_of(given, given.origin, params, context, "the truth");
  const Side mesh = side_of(*in.mesh, given.origin, params, context, "the mesh");
  if (!(truth.samples.area > 0)) throw Error("the truth has no walls, floors or ceilings: nothing to compare with");

  const double reach = std::max(*std::max_element(buffers.asked.begin(), buffers.asked.end()),
                                buffers.curve.empty() ? 0 : buffers.curve.back());
  const auto compare = [&](bool same_class) {
    return SurfaceComparison{truth, mesh, distances(truth, mesh, same_class, reach, params, context),
                             distances(mesh, truth, same_class, reach, params, context)};
  };
  Out out;
  report(out, compare(false), {}, buffers);
  if (!truth.has_classes() || !mesh.has_classes()) return out;
  const SurfaceComparison by_class = compare(true);
  for (const auto surface : structural) report(out, by_class, surface, buffers);
  return out;
}

}  // namespace atrium::metric
