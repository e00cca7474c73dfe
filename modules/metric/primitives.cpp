#include "modules/metric/primitives.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "modules/geometry/triangle_tree.hpp"
#include "modules/metric/mesh_samples.hpp"
#include "modules/metric/region_overlap.hpp"

namespace atrium::metric {
namespace {

constexpr std::int32_t none = -1;
constexpr double label_cosine = 0.7071067811865476;  // of 45°

std::vector<std::int32_t> nearest_faces(const Cloud& cloud, const GroundTruth& truth, double max_distance,
                                        const Context& context) {
  check_mesh(truth.mesh, "the truth");
  const auto& faces_of = truth.mesh.primitives;
  if (faces_of.size() != truth.mesh.triangles.size() ||
      std::any_of(faces_of.begin(), faces_of.end(),
                  [&](std::int32_t f) { return f < 0 || static_cast<std::size_t>(f) >= truth.faces.size(); }))
    throw Error(
        "the truth's mesh does not say of which face each triangle is",
        "wire a cloud with labels, or a truth whose mesh has its faces as primitives, as io.read_layout gives it");
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (!cloud.points[i].allFinite()) throw Error("point " + std::to_string(i) + " of the cloud is not finite");
  const auto vertices = vertices_about(truth.mesh, cloud.origin);
  const TriangleTree tree(vertices, truth.mesh.triangles);
  std::vector<std::int32_t> faces(cloud.size(), none);
  context.parallel_for(
      cloud.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const auto found = tree.nearest_of(
              cloud.points[i].cast<double>(), max_distance * max_distance * (1 + 1e-9), [&](std::uint32_t t) {
                if (!cloud.has_normals()) return true;
                const auto& face = truth.faces[truth.mesh.primitives[t]];
                return std::abs(face.plane.normal.dot(cloud.normals[i].cast<double>())) >= label_cosine;
              });
          if (found) faces[i] = truth.mesh.primitives[found.triangle];
        }
      },
      1024);
  return faces;
}

std::vector<std::int32_t> faces_of_points(const Cloud& cloud, const GroundTruth& truth, double max_distance,
                                          const Context& context) {
  if (cloud.labels.empty()) return nearest_faces(cloud, truth, max_distance, context);
  if (cloud.labels.size() != cloud.size())
    throw Error("the cloud has " + std::to_string(cloud.labels.size()) + " labels for " + std::to_string(cloud.size()) +
                " points");
  auto faces = cloud.labels;
  for (auto& f : faces) {
    if (f >= static_cast<std::int32_t>(truth.faces.size()))
      throw Error("a point has the label " + std::to_string(f) + ", but the truth has " +
                      std::to_string(truth.faces.size()) + " faces",
                  "wire the truth of the same simulated scan");
    f = std::max(f, none);
  }
  return faces;
}

struct PlaneComparison {
  Regions regions;
  std::size_t on_objects = 0;
};

// Found regions that are mostly on no face, and true ones with too few points, get size 0 and no overlaps.
PlaneComparison compare(const PlanePrimitives& planes, const std::vector<std::int32_t>& faces, std::size_t face_count,
                        std::size_t min_points) {
  PlaneComparison c;
  auto& r = c.regions;
  r.expected.assign(face_count, 0);
  r.found.assign(planes.primitives.size(), 0);
  for (const auto f : faces)
    if (f >= 0) ++r.expected[static_cast<std::size_t>(f)];
  for (auto& n : r.expected)
    if (n < min_points) n = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> shared;
  for (std::uint32_t p = 0; p < planes.primitives.size(); ++p) {
    const auto& inliers = planes.primitives[p].inliers;
    for (const auto i : inliers)
      if (i >= faces.size())
        throw Error("plane " + std::to_string(p) + " has point " + std::to_string(i) + " of " +
                    std::to_string(faces.size()));
    const auto off = static_cast<std::size_t>(
        std::count_if(inliers.begin(), inliers.end(), [&](std::uint32_t i) { return faces[i] < 0; }));
    if (inliers.empty() || 2 * off > inliers.size()) {
      ++c.on_objects;
      continue;
    }
    r.found[p] = inliers.size();
    for (const auto i : inliers)
      if (faces[i] >= 0 && r.expected[static_cast<std::size_t>(faces[i])] > 0)
        ++shared[{static_cast<std::uint32_t>(faces[i]), p}];
  }
  for (const auto& [pair, points] : shared) r.overlaps.push_back({pair.first, pair.second, points});
  return c;
}

std::string name_of_threshold(double threshold) {
  const double percent = std::round(threshold * 100);
  if (std::abs(threshold * 100 - percent) > 1e-6)
    throw Error("a threshold of " + std::to_string(threshold), "thresholds are whole percents, from 50 %");
  return "t" + std::to_string(static_cast<int>(percent));
}

struct Errors {
  std::vector<double> angles, offsets;
};

Errors plane_errors(const std::vector<Overlap>& pairs, const PlanePrimitives& planes, const GroundTruth& truth,
                    const std::vector<std::int32_t>& faces) {
  Errors errors;
  const Cloud& cloud = *planes.cloud;
  const Eigen::Vector3d shift = cloud.origin - truth.origin;
  for (const auto& pair : pairs) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const auto i : planes.primitives[pair.found].inliers)
      if (faces[i] == static_cast<std::int32_t>(pair.expected))
        middle += cloud.points[i].cast<double>() / static_cast<double>(pair.points);
    const Plane &found = planes.primitives[pair.found].plane, &expected = truth.faces[pair.expected].plane;
    const double sine = found.normal.cross(expected.normal).norm(), cosine = found.normal.dot(expected.normal);
    errors.angles.push_back(std::atan2(sine, std::abs(cosine)) * 180 / std::numbers::pi);
    // From the place on the true plane along its normal.
    const Eigen::Vector3d on_true = middle - expected.normal * expected.signed_distance(middle + shift);
    errors.offsets.push_back(std::abs(found.signed_distance(on_true)));
  }
  return errors;
}

double sum(const std::vector<std::size_t>& sizes) {
  double total = 0;
  for (const auto n : sizes) total += static_cast<double>(n);
  return total;
}

void report_shares(Metrics& metrics, const Regions& r) {
  std::vector<std::size_t> most(r.found.size(), 0);
  std::vector<std::uint32_t> face(r.found.size(), 0);
  for (const auto& o : r.overlaps)
    if (o.points > most[o.found]) {
      most[o.found] = o.points;
      face[o.found] = o.expected;
    }
  if (sum(r.found) > 0) metrics.values.push_back({"primitives.purity", sum(most) / sum(r.found), ""});
  if (sum(r.expected) > 0) metrics.values.push_back({"primitives.coverage", sum(most) / sum(r.expected), ""});
}

void report_errors(Metrics& metrics, const std::string& name, std::vector<double> errors, const char* unit) {
  if (errors.empty()) return;
  std::sort(errors.begin(), errors.end());
  metrics.values.push_back({name + ".median", errors[(errors.size() - 1) / 2], unit});
  metrics.values.push_back({name + ".max", errors.back(), unit});
}

}  // namespace

Primitives::Out Primitives::run(const In& in, const Params& params, Context& context) {
  if (in.truth->faces.empty()) throw Error("the truth has no faces: nothing to compare with");
  if (params.thresholds.empty()) throw Error("no thresholds", "give at least one share, 80 % for instance");
  const auto faces = faces_of_points(*in.planes->cloud, *in.truth, params.max_distance, context);
  const auto comparison =
      compare(*in.planes, faces, in.truth->faces.size(), static_cast<std::size_t>(params.min_points));
  const Regions& regions = comparison.regions;
  const auto present = [](const std::vector<std::size_t>& sizes) {
    return static_cast<double>(sizes.size() - static_cast<std::size_t>(std::count(sizes.begin(), sizes.end(), 0U)));
  };
  Out out;
  const auto add = [&](const std::string& name, double value) {
    out.metrics.values.push_back({"primitives." + name, value, ""});
  };
  const double expected = present(regions.expected), found = present(regions.found);
  add("true", expected);
  add("found", static_cast<double>(in.planes->primitives.size()));
  add("on_objects", static_cast<double>(comparison.on_objects));
  report_shares(out.metrics, regions);
  for (const double threshold : params.thresholds) {
    const auto result = compare_regions(regions, threshold);
    const auto name = name_of_threshold(threshold);
    const auto correct = static_cast<double>(result.correct.size());
    add(name + ".correct", correct);
    add(name + ".oversegmented", static_cast<double>(result.oversegmented));
    add(name + ".undersegmented", static_cast<double>(result.undersegmented));
    add(name + ".missed", static_cast<double>(result.missed));
    add(name + ".noise", static_cast<double>(result.noise));
    if (expected > 0) add(name + ".recall", correct / expected);
    if (found > 0) add(name + ".precision", correct / found);
  }
  const double lowest = *std::min_element(params.thresholds.begin(), params.thresholds.end());
  const auto errors = plane_errors(compare_regions(regions, lowest).correct, *in.planes, *in.truth, faces);
  report_errors(out.metrics, "primitives.normal_error", errors.angles, "deg");
  report_errors(out.metrics, "primitives.offset_error", errors.offsets, "m");
  return out;
}

}  // namespace atrium::metric
