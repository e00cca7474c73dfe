#pragma once
#include "modules/building/elements.hpp"

namespace atrium::building {

/// A face's outline along a line: foot and head of what it covers between its corners, ascending; empty where the face
/// is upright to the line.
std::vector<ProfilePart> profile_of(const Building& building, const BuildingFace& face, const Eigen::Vector2d& start,
                                    const Eigen::Vector2d& along);

/// The lower foot and the higher head of several profiles from 0 to `length`; where none is, what is nearest goes on
/// level. Steps of at most a centimetre in all are none.
std::vector<ProfilePart> joined_profile(const std::vector<std::vector<ProfilePart>>& profiles, double length);

/// What of a profile is between two places, counted from the first.
std::vector<ProfilePart> cut_profile(const std::vector<ProfilePart>& profile, double from, double to);

/// The closed polygon (s, z) of a profile, counter-clockwise.
PlanRing outline_of(const std::vector<ProfilePart>& profile);

}  // namespace atrium::building
