#include "modules/plane/adopt.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "graph/api/text.hpp"
#include "modules/plane/measured_plane.hpp"

namespace atrium::plane {
namespace {

constexpr std::uint32_t no_primitive = std::numeric_limits<std::uint32_t>::max();

/// A primitive's rectangle, to look points up in.
struct Frame {
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();
  Eigen::Vector3f corner = Eigen::Vector3f::Zero(), along = Eigen::Vector3f::Zero(), across = Eigen::Vector3f::Zero();
  float offset = 0, length = 0, width = 0;
  std::uint32_t primitive = no_primitive;
  bool normals_agree = false;  ///< those of its points look to the side that it was seen from
};

Frame frame_of(const MeasuredPlane& plane, std::size_t index) {
  Frame frame;
  frame.normal = plane.plane.normal.cast<float>();
  frame.offset = static_cast<float>(plane.plane.offset);
  frame.corner = plane.corners[0].cast<float>();
  const Eigen::Vector3d along = plane.corners[1] - plane.corners[0];
  const Eigen::Vector3d across = plane.corners[3] - plane.corners[0];
  frame.length = static_cast<float>(along.norm());
  frame.width = static_cast<float>(across.norm());
  if (along.norm() > 0) frame.along = along.normalized().cast<float>();
  if (across.norm() > 0) frame.across = across.normalized().cast<float>();
  frame.primitive = static_cast<std::uint32_t>(index);
  return frame;
}

/// Whether most normals of a primitive's points say the side that it is turned to: files often have them by chance.
bool normals_agree(const PlanePrimitive& primitive, const Cloud& cloud) {
  constexpr double most = 0.9;
  if (!cloud.has_normals()) return false;
  const Eigen::Vector3f normal = primitive.plane.normal.cast<float>();
  const auto agreeing = std::count_if(primitive.inliers.begin(), primitive.inliers.end(),
                                      [&](std::uint32_t i) { return normal.dot(cloud.normals[i]) > 0; });
  return static_cast<double>(agreeing) > most * static_cast<double>(primitive.inliers.size());
}

class Adoption {
 public:
  Adoption(const Cloud& cloud, const std::vector<Frame>& frames, float distance, float reach)
      : cloud_(cloud), frames_(frames), distance_(distance), reach_(reach) {}

  std::uint32_t home_of(std::size_t i) const {
    const Eigen::Vector3f& p = cloud_.points[i];
    std::uint32_t best = no_primitive;
    float least = distance_;
    for (const Frame& f : frames_) {
      const float off = std::abs(f.normal.dot(p) + f.offset);
      if (off >= least || !within(f, p) || from_behind(f, i)) continue;
      least = off;
      best = f.primitive;
    }
    return best;
  }

 private:
  bool within(const Frame& f, const Eigen::Vector3f& p) const {
    const Eigen::Vector3f d = p - f.corner;
    const float x = f.along.dot(d);
    const float y = f.across.dot(d);
    return x > -reach_ && x < f.length + reach_ && y > -reach_ && y < f.width + reach_;
  }
  bool from_behind(const Frame& f, std::size_t i) const {
    if (!cloud_.sensors.empty()) {
      const std::size_t sensor = cloud_.source.empty() ? 0 : cloud_.source[i];
      if (sensor < cloud_.sensors.size()) return f.normal.dot(cloud_.sensors[sensor]) + f.offset < 0;
    }
    return f.normals_agree && f.normal.dot(cloud_.normals[i]) < 0;
  }

  const Cloud& cloud_;
  const std::vector<Frame>& frames_;
  float distance_, reach_;
};

}  // namespace

Adopt::Out Adopt::run(const In& in, const Params& params, Context& context) {
  const Cloud& cloud = *in.planes->cloud;
  std::vector<MeasuredPlane> measured = measure_planes(*in.planes, context);
  const double distance = params.distance > 0 ? params.distance : 3 * mean_residual(measured);
  std::vector<Frame> frames;
  std::vector<std::uint32_t> home(cloud.size(), no_primitive);
  for (std::size_t i = 0; i < measured.size(); ++i) {
    if (measured[i].moments.count > 0) {
      frames.push_back(frame_of(measured[i], i));
      frames.back().normals_agree = normals_agree(in.planes->primitives[i], cloud);
    }
    for (const auto k : in.planes->primitives[i].inliers) home[k] = static_cast<std::uint32_t>(i);
  }
  const Adoption adoption(cloud, frames, static_cast<float>(distance), static_cast<float>(params.reach));
  std::vector<std::uint32_t> adopted(cloud.size(), no_primitive);
  context.parallel_for(cloud.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (home[i] == no_primitive) adopted[i] = adoption.home_of(i);
  });
  Out out{*in.planes};
  std::size_t count = 0;
  for (std::size_t i = 0; i < adopted.size(); ++i) {
    if (adopted[i] == no_primitive) continue;
    ++count;
    out.planes.primitives[adopted[i]].inliers.push_back(static_cast<std::uint32_t>(i));
    measured[adopted[i]].moments.add(cloud.points[i].cast<double>());
  }
  for (std::size_t i = 0; i < measured.size(); ++i) {
    PlanePrimitive& primitive = out.planes.primitives[i];
    std::sort(primitive.inliers.begin(), primitive.inliers.end());
    if (measured[i].moments.count > 0) primitive.residual = measured[i].rms_to(primitive.plane);
  }
  context.info(fmt::format("{} joined planes, within {:.1f} mm", counted(count, "point"), 1000 * distance));
  return out;
}

}  // namespace atrium::plane
