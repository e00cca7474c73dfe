#include "modules/baseline/sided_regions.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace atrium::baseline {
namespace {

constexpr std::size_t samples_per_primitive = 2000;
constexpr double same_direction = 0.95;  // cosine: CGAL joins planes that are up to 10° apart
constexpr double least_reach = 0.02;     // metres of an inlier from its region

struct Region {
  std::vector<std::size_t> triangles;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, of the triangles as they are
  std::int32_t primitive = -1;
  double votes = 0;  ///< inliers on it, those seen from the back negative
};

std::vector<Region> gather(const Mesh& mesh, const std::vector<std::int32_t>& regions) {
  std::vector<Region> result;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto r = static_cast<std::size_t>(regions[t]);
    if (r >= result.size()) result.resize(r + 1);
    const auto& [a, b, c] = mesh.triangles[t];
    result[r].triangles.push_back(t);
    result[r].normal += (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
  }
  for (Region& region : result) region.normal.normalize();
  return result;
}

/// Whether the foot of the perpendicular from p on the region's plane is within one of its triangles.
bool stands_on(const Eigen::Vector3d& p, const Region& region, const Mesh& mesh) {
  return std::any_of(region.triangles.begin(), region.triangles.end(), [&](std::size_t t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d& a = mesh.vertices[mesh.triangles[t][k]];
      const Eigen::Vector3d& b = mesh.vertices[mesh.triangles[t][(k + 1) % 3]];
      if ((b - a).cross(p - a).dot(region.normal) < 0) return false;
    }
    return true;
  });
}

/// The inliers of the primitive that stand on the region, estimated from evenly spread ones.
double support(const PlanePrimitive& primitive, const Region& region, const Mesh& mesh, const Cloud& cloud) {
  const double reach = std::max(least_reach, 4 * primitive.residual);
  const std::size_t step = 1 + primitive.inliers.size() / samples_per_primitive;
  const Eigen::Vector3d corner = mesh.vertices[mesh.triangles[region.triangles.front()][0]];
  std::size_t hits = 0;
  for (std::size_t i = 0; i < primitive.inliers.size(); i += step) {
    const Eigen::Vector3d p = cloud.points[primitive.inliers[i]].cast<double>();
    if (std::abs(region.normal.dot(p - corner)) < reach && stands_on(p, region, mesh)) ++hits;
  }
  return static_cast<double>(hits * step);
}

/// Largest distance of the region's corners from the plane.
double distance(const Plane& plane, const Region& region, const Mesh& mesh) {
  double result = 0;
  for (const std::size_t t : region.triangles)
    for (const std::uint32_t v : mesh.triangles[t])
      result = std::max(result, std::abs(plane.signed_distance(mesh.vertices[v])));
  return result;
}

void choose_primitive(Region& region, const Mesh& mesh, const PlanePrimitives& planes, std::size_t used) {
  double most = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < used; ++i) {
    const PlanePrimitive& primitive = planes.primitives[i];
    const double cosine = region.normal.dot(primitive.plane.normal);
    if (std::abs(cosine) < same_direction) continue;
    const double inliers = support(primitive, region, mesh, *planes.cloud);
    region.votes += std::copysign(inliers, cosine);
    const double away = distance(primitive.plane, region, mesh);
    if (inliers > most || (most == 0 && away < nearest)) region.primitive = static_cast<std::int32_t>(i);
    most = std::max(most, inliers);
    nearest = std::min(nearest, away);
  }
}

struct Link {
  std::size_t region;
  bool same;  ///< both are seen from the same side of the surface as they are
};

/// Which regions each one meets at edges that no third one has.
std::vector<std::vector<Link>> links_of(const std::vector<Region>& regions, const Mesh& mesh) {
  struct Side {
    std::size_t region;
    bool forward;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Side>> edges;
  for (std::size_t r = 0; r < regions.size(); ++r)
    for (const std::size_t t : regions[r].triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = mesh.triangles[t][k];
        const std::uint32_t b = mesh.triangles[t][(k + 1) % 3];
        edges[std::minmax(a, b)].push_back({r, a < b});
      }
  std::vector<std::vector<Link>> links(regions.size());
  for (const auto& [edge, sides] : edges) {
    if (sides.size() != 2 || sides[0].region == sides[1].region) continue;
    const bool same = sides[0].forward != sides[1].forward;
    links[sides[0].region].push_back({sides[1].region, same});
    links[sides[1].region].push_back({sides[0].region, same});
  }
  return links;
}

/// Whether each region is to be turned, part by part: what is linked has one front.
std::vector<bool> turned(const std::vector<Region>& regions, const Mesh& mesh) {
  const auto links = links_of(regions, mesh);
  std::vector<bool> reached(regions.size());
  std::vector<bool> turn(regions.size());
  for (std::size_t seed = 0; seed < regions.size(); ++seed) {
    if (reached[seed]) continue;
    std::vector<std::size_t> part{seed};
    reached[seed] = true;
    double votes = 0;
    for (std::size_t k = 0; k < part.size(); ++k) {
      const std::size_t r = part[k];
      votes += turn[r] ? -regions[r].votes : regions[r].votes;
      for (const Link& link : links[r]) {
        if (reached[link.region]) continue;
        reached[link.region] = true;
        turn[link.region] = link.same == turn[r];
        part.push_back(link.region);
      }
    }
    if (votes < 0)
      for (const std::size_t r : part) turn[r] = !turn[r];
  }
  return turn;
}

}  // namespace

void take_sides(Mesh& mesh, const std::vector<std::int32_t>& regions, const PlanePrimitives& planes, std::size_t used) {
  std::vector<Region> all = gather(mesh, regions);
  for (Region& region : all) choose_primitive(region, mesh, planes, used);
  const std::vector<bool> turn = turned(all, mesh);
  mesh.primitives.assign(mesh.triangles.size(), -1);
  for (std::size_t r = 0; r < all.size(); ++r)
    for (const std::size_t t : all[r].triangles) {
      mesh.primitives[t] = all[r].primitive;
      if (turn[r]) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    }
}

}  // namespace atrium::baseline
