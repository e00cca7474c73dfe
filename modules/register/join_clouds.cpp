#include "modules/register/join_clouds.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace atrium::registration {
namespace {

/// Whether all clouds with points have the column; warns if only some have.
template <class T>
bool all_have(const Inputs<Cloud>& clouds, std::vector<T> Cloud::*column, std::string_view name,
              const Context& context) {
  std::size_t with = 0, all = 0;
  for (const auto& c : clouds) {
    if (c->size() == 0) continue;
    ++all;
    with += ((*c).*column).empty() ? 0 : 1;
  }
  if (with > 0 && with < all)
    context.warn(fmt::format("{} of {} scans have no {}: the column is dropped", all - with, all, name));
  return with == all && all > 0;
}

template <class T>
void append(std::vector<T>& column, const std::vector<T>& other) {
  column.insert(column.end(), other.begin(), other.end());
}

/// All sensors, and each point's.
void join_sensors(const Inputs<Cloud>& clouds, const Poses& poses, Cloud& result, const Context& context) {
  const bool known = std::all_of(clouds.begin(), clouds.end(), [](const auto& c) {
    return c->size() == 0 || c->sensors.size() == 1 || (!c->sensors.empty() && !c->source.empty());
  });
  if (!known) {
    const bool any = std::any_of(clouds.begin(), clouds.end(), [](const auto& c) { return !c->sensors.empty(); });
    if (any) context.warn("not every scan says which sensor saw its points: sensor positions are dropped");
    return;
  }
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    const Cloud& cloud = *clouds[i];
    const std::size_t first = result.sensors.size();
    if (first + cloud.sensors.size() > 65536) throw Error("more than 65536 sensor positions");
    const Transform& t = poses.transforms[i];
    for (const auto& s : cloud.sensors)
      result.sensors.emplace_back(
          (t.rotation * (cloud.origin + s.cast<double>()) + t.translation - result.origin).cast<float>());
    for (std::size_t k = 0; k < cloud.size(); ++k)
      result.source.push_back(static_cast<std::uint16_t>(first + (cloud.source.empty() ? 0 : cloud.source[k])));
  }
  if (result.sensors.size() == 1) result.source.clear();
}

}  // namespace

Cloud join(const Inputs<Cloud>& clouds, const Poses& poses, const Context& context) {
  Cloud result;
  result.origin = clouds.front()->origin;
  result.unit = clouds.front()->unit;
  result.y_up = clouds.front()->y_up;
  result.crs = clouds.front()->crs;
  const bool normals = all_have(clouds, &Cloud::normals, "normals", context);
  const bool colours = all_have(clouds, &Cloud::colours, "colours", context);
  const bool labels = all_have(clouds, &Cloud::labels, "labels", context);
  const bool intensities = all_have(clouds, &Cloud::intensities, "intensities", context);
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    const Cloud& cloud = *clouds[i];
    const Transform& t = poses.transforms[i];
    const Eigen::Matrix3f turn = t.rotation.cast<float>();
    const Eigen::Vector3d shift = t.rotation * cloud.origin + t.translation - result.origin;
    for (const auto& p : cloud.points)
      result.points.emplace_back((t.rotation * p.cast<double>() + shift).cast<float>());
    if (normals)
      for (const auto& n : cloud.normals) result.normals.emplace_back((turn * n).normalized());
    if (colours) append(result.colours, cloud.colours);
    if (labels) append(result.labels, cloud.labels);
    if (intensities) append(result.intensities, cloud.intensities);
  }
  join_sensors(clouds, poses, result, context);
  return result;
}

}  // namespace atrium::registration
