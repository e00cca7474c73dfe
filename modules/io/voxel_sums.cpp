#include "modules/io/voxel_sums.hpp"

#include <algorithm>
#include <utility>

namespace atrium::io {

void VoxelSums::add(std::uint64_t key, const Cloud& cloud, std::size_t i) {
  const std::uint32_t v = keys_.add(key);
  if (v == places_.size()) add_column_entries(cloud, i);
  Place& place = places_[v];
  place.x += static_cast<double>(cloud.points[i].x());
  place.y += static_cast<double>(cloud.points[i].y());
  place.z += static_cast<double>(cloud.points[i].z());
  place.count = place.count + 1;
  if (!cloud.normals.empty())
    for (std::size_t a = 0; a < 3; ++a)
      normals_[v].sum[a] += static_cast<double>(cloud.normals[i][static_cast<Eigen::Index>(a)]);
  if (!cloud.colours.empty()) add_colour(v, cloud.colours[i]);
  if (!cloud.intensities.empty()) intensities_[v] += static_cast<double>(cloud.intensities[i]);
  if (!cloud.labels.empty() && cloud.labels[i] != labels_[v]) count_label(v, cloud.labels[i]);
}

void VoxelSums::add_column_entries(const Cloud& cloud, std::size_t i) {
  places_.push_back({});
  if (!cloud.normals.empty()) {
    const Eigen::Vector3f& n = cloud.normals[i];
    normals_.push_back({{}, {n.x(), n.y(), n.z()}});
  }
  if (!cloud.colours.empty()) colours_.push_back({});
  if (!cloud.intensities.empty()) intensities_.push_back(0);
  if (!cloud.source.empty()) sources_.push_back(cloud.source[i]);
  if (!cloud.labels.empty()) labels_.push_back(cloud.labels[i]);
}

void VoxelSums::add_colour(std::uint32_t voxel, const Colour& colour) {
  auto& sums = colours_[voxel];
  for (std::size_t c = 0; c < 3; ++c) {
    sums[c] += colour[c];
    if (sums[c] < colour[c]) ++colour_carries_[std::uint64_t{3} * voxel + c];
  }
}

void VoxelSums::count_label(std::uint32_t voxel, std::int32_t label) {
  const std::uint32_t n =
      other_labels_.add(static_cast<std::uint64_t>(voxel) << 32U | static_cast<std::uint32_t>(label));
  if (n == other_counts_.size()) other_counts_.push_back(0);
  ++other_counts_[n];
}

void VoxelSums::close() {
  keys_.close();
  other_labels_.close();
  choose_labels();
}

/// The most frequent one of each voxel, of equals the lowest number.
void VoxelSums::choose_labels() {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> counts;
  counts.reserve(other_labels_.size());
  for (std::size_t n = 0; n < other_labels_.size(); ++n) counts.emplace_back(other_labels_.key(n), other_counts_[n]);
  other_labels_ = {};
  other_counts_.clear();
  std::sort(counts.begin(), counts.end());
  for (auto first = counts.begin(); first != counts.end();) {
    const std::uint64_t voxel = first->first >> 32U;
    auto last = first;
    std::uint32_t most = places_[voxel].count;
    for (; last != counts.end() && last->first >> 32U == voxel; ++last) most -= last->second;
    std::int32_t& best = labels_[voxel];
    for (; first != last; ++first) {
      const auto label = static_cast<std::int32_t>(static_cast<std::uint32_t>(first->first));
      if (first->second < most || (first->second == most && label > best)) continue;
      most = first->second;
      best = label;
    }
  }
}

Eigen::Vector3f VoxelSums::point(std::size_t voxel) const {
  const Place& p = places_[voxel];
  return (Eigen::Vector3d(p.x, p.y, p.z) / static_cast<double>(p.count)).cast<float>();
}

Eigen::Vector3f VoxelSums::normal(std::size_t voxel) const {
  const Normal& n = normals_[voxel];
  const Eigen::Vector3d sum(n.sum[0], n.sum[1], n.sum[2]);
  const double length = sum.norm();
  if (length < 1e-3 * static_cast<double>(points(voxel))) return {n.first[0], n.first[1], n.first[2]};
  return (sum / length).cast<float>();
}

Colour VoxelSums::colour(std::size_t voxel) const {
  const std::uint64_t count = points(voxel);
  Colour mean{};
  for (std::size_t c = 0; c < 3; ++c) {
    std::uint64_t sum = colours_[voxel][c];
    if (!colour_carries_.empty())
      if (const auto carries = colour_carries_.find(3 * voxel + c); carries != colour_carries_.end())
        sum += static_cast<std::uint64_t>(carries->second) << 32U;
    mean[c] = static_cast<std::uint8_t>((sum + count / 2) / count);
  }
  return mean;
}

float VoxelSums::intensity(std::size_t voxel) const {
  return static_cast<float>(intensities_[voxel] / static_cast<double>(points(voxel)));
}

}  // namespace atrium::io
