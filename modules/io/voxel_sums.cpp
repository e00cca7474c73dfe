#include "modules/io/voxel_sums.hpp"

#include <algorithm>

namespace atrium::io {

void VoxelSums::add(std::uint64_t key, const Cloud& cloud, std::size_t i) {
  const std::size_t v = keys_.add(key);
  const bool is_new = v == places_.size();
  if (is_new) {
    places_.emplace_back();
    if (!cloud.normals.empty()) normals_.push_back({Eigen::Vector3d::Zero(), cloud.normals[i]});
    if (!cloud.colours.empty()) colours_.push_back({});
    if (!cloud.intensities.empty()) intensities_.push_back(0);
    if (!cloud.source.empty()) sources_.push_back(cloud.source[i]);
    if (!cloud.labels.empty()) labels_.push_back(cloud.labels[i]);
  }
  places_[v].sum += cloud.points[i].cast<double>();
  ++places_[v].count;
  if (!cloud.normals.empty()) normals_[v].sum += cloud.normals[i].cast<double>();
  if (!cloud.colours.empty())
    for (std::size_t c = 0; c < 3; ++c) colours_[v][c] += cloud.colours[i][c];
  if (!cloud.intensities.empty()) intensities_[v] += static_cast<double>(cloud.intensities[i]);
  if (cloud.labels.empty() || cloud.labels[i] == labels_[v]) return;
  auto& others = other_labels_[static_cast<std::uint32_t>(v)];
  const auto known =
      std::find_if(others.begin(), others.end(), [&](const auto& o) { return o.first == cloud.labels[i]; });
  if (known == others.end())
    others.emplace_back(cloud.labels[i], 1U);
  else
    ++known->second;
}

std::int32_t VoxelSums::most_frequent(std::size_t voxel) const {
  std::int32_t best = labels_[voxel];
  const auto others = other_labels_.find(static_cast<std::uint32_t>(voxel));
  if (others == other_labels_.end()) return best;
  std::uint64_t most = places_[voxel].count;
  for (const auto& [label, count] : others->second) most -= count;
  for (const auto& [label, count] : others->second)
    if (count > most || (count == most && label < best)) {
      most = count;
      best = label;
    }
  return best;
}

void VoxelSums::put(std::size_t voxel, Cloud& cloud, std::size_t place) const {
  const Place& p = places_[voxel];
  const auto count = static_cast<double>(p.count);
  cloud.points[place] = (p.sum / count).cast<float>();
  if (!normals_.empty()) {
    const Normal& n = normals_[voxel];
    const double length = n.sum.norm();
    cloud.normals[place] = length < 1e-3 * count ? n.first : Eigen::Vector3f((n.sum / length).cast<float>());
  }
  if (!colours_.empty())
    for (std::size_t c = 0; c < 3; ++c)
      cloud.colours[place][c] = static_cast<std::uint8_t>((colours_[voxel][c] + p.count / 2) / p.count);
  if (!intensities_.empty()) cloud.intensities[place] = static_cast<float>(intensities_[voxel] / count);
  if (!sources_.empty()) cloud.source[place] = sources_[voxel];
  if (!labels_.empty()) cloud.labels[place] = most_frequent(voxel);
}

}  // namespace atrium::io
