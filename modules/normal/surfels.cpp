#include "modules/normal/surfels.hpp"

#include <array>
#include <cmath>

namespace atrium::normal {
namespace {

constexpr float same_axis = 0.7F;  // cosine within a voxel
constexpr float smooth = 0.9F;     // cosine between neighbours
constexpr float in_plane = 0.5F;   // of a voxel's edge
constexpr std::size_t max_planes = 6;

struct Group {
  Eigen::Vector3f axis, seed;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), normals = Eigen::Vector3d::Zero();
  std::uint32_t n = 0;
  int balance = 0;  // points on the axis' side less those on the other
};

/// The groups of a cell's points; of_point gets each point's group.
std::vector<Group> groups_of(const Cloud& cloud, const PointGrid& grid, const PointGrid::Cell& cell,
                             std::vector<std::uint32_t>& of_point) {
  const float off = in_plane * static_cast<float>(grid.cell_size());
  std::vector<Group> groups;
  for (std::uint32_t i = cell.begin; i < cell.end; ++i) {
    const Eigen::Vector3f& normal = cloud.normals[grid.order()[i]];
    std::size_t best = 0;
    float cosine = 0;
    const Eigen::Vector3f at = grid.points()[i];
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const float c = groups[g].axis.dot(normal);
      if (std::abs(c) <= std::abs(cosine) || std::abs(groups[g].axis.dot(at - groups[g].seed)) > off) continue;
      cosine = c;
      best = g;
    }
    if (std::abs(cosine) < same_axis && (groups.empty() || groups.size() < max_planes)) {
      best = groups.size();
      groups.push_back({normal, at});
      cosine = 1;
    }
    Group& group = groups[best];
    group.sum += grid.points()[i].cast<double>();
    group.normals += (cosine < 0 ? -1.0 : 1.0) * normal.cast<double>();
    group.balance += cosine < 0 ? -1 : 1;
    ++group.n;
    of_point[i] = static_cast<std::uint32_t>(best);
  }
  return groups;
}

}  // namespace

Surfels::Surfels(const Cloud& cloud, const PointGrid& grid, const Context& context) {
  gather(cloud, grid, context);
  grow(grid, context);
}

void Surfels::gather(const Cloud& cloud, const PointGrid& grid, const Context& context) {
  const auto& cells = grid.cells();
  of_point.resize(grid.inside());
  first.assign(cells.size() + 1, 0);
  constexpr std::size_t chunk = 1024;
  std::vector<std::vector<Surfel>> parts((cells.size() + chunk - 1) / chunk);
  context.parallel_chunks(cells.size(), chunk, [&](std::size_t part, std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      const std::vector<Group> groups = groups_of(cloud, grid, cells[c], of_point);
      for (const Group& g : groups) {
        const Eigen::Vector3f axis = (g.balance < 0 ? -1.0F : 1.0F) * g.normals.normalized().cast<float>();
        parts[part].push_back({axis, (g.sum / g.n).cast<float>(), static_cast<std::uint32_t>(c)});
      }
      first[c + 1] = static_cast<std::uint32_t>(groups.size());
    }
  });
  for (const auto& part : parts) surfels.insert(surfels.end(), part.begin(), part.end());
  for (std::size_t c = 0; c < cells.size(); ++c) first[c + 1] += first[c];
  context.parallel_for(cells.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c)
      for (std::uint32_t i = cells[c].begin; i < cells[c].end; ++i) of_point[i] += first[c];
  });
}

void Surfels::grow(const PointGrid& grid, const Context& context) {
  const float off = in_plane * static_cast<float>(grid.cell_size());
  signs.assign(surfels.size(), 0);
  for (std::uint32_t seed = 0; seed < surfels.size(); ++seed) {
    if (signs[seed] != 0) continue;
    context.check_cancelled();
    signs[seed] = 1;
    std::vector<std::uint32_t> region{seed};
    for (std::size_t next = 0; next < region.size(); ++next) {
      const std::uint32_t s = region[next];
      for (const auto c : grid.neighbourhood(grid.cells()[surfels[s].cell])) {
        if (c == PointGrid::none) continue;
        for (std::uint32_t t = first[c]; t < first[c + 1]; ++t) {
          if (signs[t] != 0) continue;
          const float cosine = surfels[s].axis.dot(surfels[t].axis);
          const Eigen::Vector3f step = surfels[t].centre - surfels[s].centre;
          if (std::abs(cosine) < smooth || std::abs(surfels[s].axis.dot(step)) > off ||
              std::abs(surfels[t].axis.dot(step)) > off)
            continue;
          signs[t] = cosine < 0 ? -signs[s] : signs[s];
          region.push_back(t);
        }
      }
    }
    regions.push_back(std::move(region));
  }
}

}  // namespace atrium::normal
