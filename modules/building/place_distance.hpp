#pragma once
#include <Eigen/Core>
#include <vector>

#include "modules/types/building.hpp"

/// How far a place is from what a building has, in metres: in plan, and over or below it as well where the place has a
/// height. 0 within its plan.
namespace atrium::building {

/// A place in the building's coordinates. Where only its plan is known, z is that of what it is compared with.
struct NearPlace {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  bool has_height = false;
};

double distance_to(const NearPlace& place, const std::vector<Eigen::Vector3d>& ring);
/// From the nearer of its two outlines.
double distance_to(const NearPlace& place, const BuildingOpening& opening);
double distance_to(const NearPlace& place, const Building& building, const BuildingFace& face);
/// Columns and shafts in the room count as part of it.
double distance_to(const NearPlace& place, const Building& building, const BuildingRoom& room);
/// How deep the place lies within the room's plan; 0 outside, and above and below the room.
double depth_in(const NearPlace& place, const Building& building, const BuildingRoom& room);

}  // namespace atrium::building
