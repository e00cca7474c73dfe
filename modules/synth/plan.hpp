#pragma once
#include <Eigen/Core>
#include <vector>

namespace atrium::synth {

using Ring2 = std::vector<Eigen::Vector2d>;

/// A rectangle on the floor plan, turned by `yaw` (radians).
struct Footprint {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  Eigen::Vector2d half = Eigen::Vector2d::Zero();  ///< half width and depth
  double yaw = 0;
  double height = 0;  ///< how tall the thing is that stands on it

  Ring2 corners() const;
  double distance(const Eigen::Vector2d& p) const;  ///< 0 inside
};

/// Whether the rectangles come nearer to each other than `gap` (separating axes of both, grown by gap).
bool overlap(const Footprint& a, const Footprint& b, double gap);
bool inside(const Ring2& ring, const Eigen::Vector2d& p);
/// Whether the rectangle lies in the ring.
bool inside(const Ring2& ring, const Footprint& footprint);
double distance_to_border(const Ring2& ring, const Eigen::Vector2d& p);

/// The ring with side i (from corner i to the next) moved inwards by by[i], outwards where that is negative. No two
/// neighbouring sides may be parallel.
Ring2 inset(const Ring2& ring, const std::vector<double>& by);
/// Moves the part of a side between `from` and `to` metres from its start inwards by `depth` (a chimney breast), or
/// outwards if that is negative (a niche). Sides after it are counted four further.
void set_back(Ring2& ring, std::size_t side, double from, double to, double depth);
/// A regular polygon, its first corner at angle 0.
Ring2 regular_polygon(const Eigen::Vector2d& centre, double radius, int corners);

/// Up to `count` places for a scanner: the first has most room around it; each further one sees most of the outline
/// that those before do not see, is as far as may be from them, and has 0.45 m around it (0.25 m, if only so a second
/// one is found). Deterministic; at least one unless the ring is thinner than the 0.2 m raster.
Ring2 scanner_places(const Ring2& room, const std::vector<Footprint>& furniture, std::size_t count);

}  // namespace atrium::synth
