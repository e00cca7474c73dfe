#include "modules/building/place_distance.hpp"

#include <algorithm>
#include <cmath>

namespace atrium::building {
namespace {

using PlaceRing = std::vector<Eigen::Vector3d>;

double distance_to_edges(const Eigen::Vector2d& p, const PlaceRing& ring) {
  double least = 1e300;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d a = ring[i].head<2>(), side = ring[(i + 1) % ring.size()].head<2>() - a;
    const double t = std::clamp(side.dot(p - a) / std::max(side.squaredNorm(), 1e-12), 0.0, 1.0);
    least = std::min(least, (p - a - t * side).norm());
  }
  return least;
}

bool is_inside(const Eigen::Vector2d& p, const PlaceRing& ring) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector3d &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y())) inside = !inside;
  }
  return inside;
}

double distance_in_plan(const Eigen::Vector2d& p, const PlaceRing& ring) {
  return is_inside(p, ring) ? 0 : distance_to_edges(p, ring);
}

struct HeightRange {
  double low = 1e300, high = -1e300;
  void take(double z) {
    low = std::min(low, z);
    high = std::max(high, z);
  }
  double from(double z) const { return std::max({low - z, z - high, 0.0}); }
};

PlaceRing corners(const Building& building, const BuildingFace& face) {
  PlaceRing ring;
  ring.reserve(face.outline.size());
  for (const auto v : face.outline) ring.push_back(building.vertices[v]);
  return ring;
}

/// How far the place is over or below the room.
double height_distance(const NearPlace& place, const Building& building, const BuildingRoom& room) {
  if (!place.has_height) return 0;
  HeightRange heights;
  for (const auto f : room.faces)
    for (const auto v : building.faces[static_cast<std::size_t>(f)].outline) heights.take(building.vertices[v].z());
  return heights.from(place.at.z());
}

}  // namespace

double distance_to(const NearPlace& place, const PlaceRing& ring) {
  if (ring.empty()) return 1e300;
  const double across = distance_in_plan(place.at.head<2>(), ring);
  if (!place.has_height) return across;
  HeightRange heights;
  for (const auto& p : ring) heights.take(p.z());
  return std::hypot(across, heights.from(place.at.z()));
}

double distance_to(const NearPlace& place, const BuildingOpening& opening) {
  return std::min(distance_to(place, opening.outline_a), distance_to(place, opening.outline_b));
}

double distance_to(const NearPlace& place, const Building& building, const BuildingFace& face) {
  return distance_to(place, corners(building, face));
}

double distance_to(const NearPlace& place, const Building& building, const BuildingRoom& room) {
  if (room.outline.empty()) return 1e300;
  return std::hypot(distance_in_plan(place.at.head<2>(), room.outline), height_distance(place, building, room));
}

double depth_in(const NearPlace& place, const Building& building, const BuildingRoom& room) {
  const Eigen::Vector2d p = place.at.head<2>();
  if (!is_inside(p, room.outline) || height_distance(place, building, room) > 0) return 0;
  return distance_to_edges(p, room.outline);
}

}  // namespace atrium::building
