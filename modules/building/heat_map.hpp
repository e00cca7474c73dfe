#pragma once
#include <string>
#include <vector>

#include "modules/building/face_distances.hpp"

namespace atrium::building {

struct HeatMapFace {
  const FaceDistances* distances = nullptr;
  std::size_t face = 0;  ///< its number in the building: the group `face-12` in the page
  std::int32_t storey = 0;
  std::string caption, figures;
};

/// The same as JSON, to be painted onto the faces (heat_maps.json, as building.accuracy documents it). `origin` is the
/// mesh's.
std::string heat_map_table(const std::vector<FaceDistances>& faces, const Eigen::Vector3d& origin, double cell,
                           double range);

/// An SVG page of faces as seen from their rooms, storey by storey, their squares coloured by the mean signed distance
/// from −range (blue) to +range (red), with a scale.
std::string heat_map(const std::vector<HeatMapFace>& faces, double cell, double range);

}  // namespace atrium::building
