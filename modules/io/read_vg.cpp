#include "modules/io/read_vg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "graph/api/text.hpp"
#include "modules/geometry/moments.hpp"
#include "modules/io/decode.hpp"
#include "modules/io/paths.hpp"
#include "modules/io/vg_file.hpp"

namespace atrium::io {
namespace {

constexpr std::uint32_t no_point = std::numeric_limits<std::uint32_t>::max();

struct Counts {
  std::size_t other_types = 0, empty = 0, degenerate = 0, refitted = 0, shared_points = 0;
};

/// Turns groups into primitives; knows the cloud, and which points are taken.
class Converter {
 public:
  /// place: index in the cloud of each point of the file, no_point for dropped ones.
  Converter(const Cloud& cloud, const std::vector<std::uint32_t>& place, double scale)
      : cloud_(cloud), place_(place), scale_(scale), taken_(cloud.size(), false) {}

  void add(const VgGroup& group) {
    if (group.type != 0) {
      ++counts.other_types;
      return;
    }
    PlanePrimitive primitive;
    for (const auto p : group.points) {
      const std::uint32_t i = place_[p];
      if (i == no_point) continue;
      if (taken_[i]) {
        ++counts.shared_points;
        continue;
      }
      taken_[i] = true;
      primitive.inliers.push_back(i);
    }
    if (primitive.inliers.empty()) {
      ++counts.empty;
      return;
    }
    std::sort(primitive.inliers.begin(), primitive.inliers.end());
    if (!set_plane(group, primitive)) {
      for (const auto i : primitive.inliers) taken_[i] = false;
      ++counts.degenerate;
      return;
    }
    primitives.push_back(std::move(primitive));
  }

  std::vector<PlanePrimitive> primitives;
  Counts counts;

 private:
  Eigen::Vector3d point(std::uint32_t i) const { return cloud_.points[i].cast<double>(); }

  double rms(const std::vector<std::uint32_t>& inliers, const Plane& plane) const {
    double sum = 0;
    for (const auto i : inliers) {
      const double d = plane.signed_distance(point(i));
      sum += d * d;
    }
    return std::sqrt(sum / static_cast<double>(inliers.size()));
  }

  /// The file's plane in the cloud's coordinates, if it is one.
  std::optional<Plane> stated(const VgGroup& group) const {
    if (!group.plane) return std::nullopt;
    const auto& [a, b, c, d] = *group.plane;
    const Eigen::Vector3d normal(a, b, c);
    if (!normal.allFinite() || !std::isfinite(d) || std::abs(normal.norm() - 1.0) > 1e-3) return std::nullopt;
    const double length = normal.norm();
    return Plane{normal / length, normal.dot(cloud_.origin) / length + d / length * scale_};
  }

  PlaneFit fit(const std::vector<std::uint32_t>& inliers) const {
    const Eigen::Vector3d reference = point(inliers.front());
    Moments moments;
    for (const auto i : inliers) moments.add(point(i) - reference);
    PlaneFit result = fit_plane(moments);
    result.plane.offset -= result.plane.normal.dot(reference);
    return result;
  }

  /// False if the points do not define a plane and the file does not state one.
  bool set_plane(const VgGroup& group, PlanePrimitive& primitive) {
    const auto& inliers = primitive.inliers;
    const std::optional<Plane> plane = stated(group);
    const PlaneFit best = fit(inliers);
    const bool fits = inliers.size() >= 3 && best.variances[1] > 1e-12;
    // A plane that passes further from its points than the best one by more than a millimetre is not theirs: its offset
    // was written with too few digits, or it belongs to another frame.
    if (plane && (!fits || rms(inliers, *plane) <= 2.0 * rms(inliers, best.plane) + 1e-3)) {
      primitive.plane = *plane;
    } else if (fits) {
      primitive.plane = turned(best.plane, group, inliers);
      ++counts.refitted;
    } else {
      return false;
    }
    primitive.residual = rms(inliers, primitive.plane);
    return true;
  }

  /// The plane with its normal to the side of the points' normals, else of the file's parameters.
  Plane turned(const Plane& plane, const VgGroup& group, const std::vector<std::uint32_t>& inliers) const {
    Eigen::Vector3d towards = Eigen::Vector3d::Zero();
    if (cloud_.has_normals())
      for (const auto i : inliers) towards += cloud_.normals[i].cast<double>();
    else if (group.plane)
      towards = {(*group.plane)[0], (*group.plane)[1], (*group.plane)[2]};
    return plane.normal.dot(towards) < 0 ? Plane{-plane.normal, -plane.offset} : plane;
  }

  const Cloud& cloud_;
  const std::vector<std::uint32_t>& place_;
  double scale_;
  std::vector<bool> taken_;
};

void report(const std::string& path, const Counts& counts, const Context& context) {
  const auto warn = [&](std::size_t number, std::string_view one, std::string_view many, std::string_view rest) {
    if (number > 0) context.warn(fmt::format("{}: {}{}", path, counted(number, one, many), rest));
  };
  warn(counts.other_types, "group is no plane", "groups are no planes", ": skipped");
  warn(counts.empty, "group has no points of its own", "groups have no points of their own", ": skipped");
  warn(counts.degenerate, "group states no plane and has", "groups state no plane and have",
       " too few points for one: skipped");
  warn(counts.refitted, "plane", "planes",
       " fitted to the points: the file's parameters are zero or not those of the points");
  warn(counts.shared_points, "point is", "points are", " in more than one group: kept in the first");
}

}  // namespace

ReadVg::Out ReadVg::run(const Params& params, Context& context) {
  const std::string& path = params.path.path;
  const MappedFile mapped(path);
  if (mapped.size() == 0) throw Error(path + ": the file is empty");
  const std::string extension = extension_of(path);
  if (extension != ".vg" && extension != ".bvg")
    throw Error(path + ": unknown format '" + extension + "'", "known: .vg, .bvg");
  const auto stream = extension == ".vg" ? vg_text_stream(mapped) : vg_binary_stream(mapped);
  const VgFile file = read_vg_file(*stream, path);
  std::vector<std::uint32_t> kept;
  auto cloud = std::make_shared<const Cloud>(decode_cloud(file.geometry, params.scale, context, &kept));
  std::vector<std::uint32_t> place(file.geometry.count, no_point);
  for (std::uint32_t i = 0; i < kept.size(); ++i) place[kept[i]] = i;

  Converter converter(*cloud, place, params.scale);
  for (const auto& group : file.groups) converter.add(group);
  report(path, converter.counts, context);
  PlanePrimitives planes{cloud, std::move(converter.primitives)};
  std::stable_sort(planes.primitives.begin(), planes.primitives.end(),
                   [](const auto& a, const auto& b) { return a.inliers.size() > b.inliers.size(); });
  return {std::move(planes)};
}

}  // namespace atrium::io
