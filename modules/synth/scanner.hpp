#pragma once
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "modules/geometry/triangle_tree.hpp"
#include "modules/synth/people.hpp"
#include "modules/synth/stations.hpp"
#include "modules/synth/world.hpp"

namespace atrium::synth {

/// What one ray found, in the scene's frame.
struct Echo {
  std::size_t station = 0;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< as the ray left the scanner, unit length
  double range = 0;                                     ///< over all mirrors
  std::int32_t label = -1;
  Colour colour{0, 0, 0};
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< at the place that the scanner believes in
};

/// Casts rays into a world and measures what they find. Safe to use from several threads, each with its own Random.
class Scanner {
 public:
  /// Errors: no stations, more than 65535.
  Scanner(const SimulatedScene& scene, const Scan::Params& params, const Context& context);

  const std::vector<Station>& stations() const { return stations_; }
  /// The echo of point `point` of `total`, without errors of measurement but with mixed pixels. Throws where a station
  /// sees nothing.
  Echo look(std::size_t point, std::size_t total, std::size_t& last_station, Random& random) const;
  /// Where the scanner puts the echo: with noise and drift, or an outlier (then the echo's label becomes −1).
  Eigen::Vector3d measure(Echo& echo, Random& random) const;

 private:
  std::optional<Echo> cast(std::size_t station, const Eigen::Vector3d& direction, double share, Random& random) const;
  Echo sweep(std::size_t point, std::size_t total, Random& random) const;
  Echo uniform_area(std::size_t point, std::size_t total, std::size_t& last_station, Random& random) const;
  Eigen::Vector3d direction_of(const Station& station, double azimuth, Random& random) const;
  void mix(Echo& echo, double share, Random& random) const;
  void index(const SimulatedScene& scene);

  const Scan::Params& params_;
  World world_;
  std::int32_t person_ = -1;
  TriangleTree tree_;
  std::vector<Station> stations_;
  std::optional<People> people_;
  std::vector<Eigen::Vector3d> normals_;
  std::vector<double> areas_;  // running sums of those that answer
  Eigen::AlignedBox3d box_;    // of the scene alone
};

}  // namespace atrium::synth
