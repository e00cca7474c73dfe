#pragma once
#include <Eigen/Geometry>
#include <functional>
#include <string>
#include <vector>

#include "graph/api/node.hpp"
#include "modules/geometry/point_tree.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/metrics.hpp"
#include "modules/types/poses.hpp"

namespace atrium::registration {

using Points = std::vector<Eigen::Vector3f>;

/// What an algorithm finds for two sets of points.
struct PairMotion {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();  ///< from source to target
  bool converged = false;
};
using AlignPair = std::function<PairMotion(const Points& source, const Points& target)>;

struct RegisterSettings {
  double voxel = 0.1;           ///< spacing of the points that are registered, metres
  double reach = 0.5;           ///< of neighbours that count as overlap, metres
  std::vector<double> initial;  ///< x y z (metres) and yaw (degrees) of each scan after the first, or nothing
  std::string method;           ///< as warnings call it
};
struct RegisteredScans {
  Cloud cloud;
  Poses poses;
  Metrics metrics;
};

/// Fewer thinned points than this cannot be registered.
constexpr std::size_t least_registered = 30;

/// Brings scans into the frame of the first, each by `align` to all before it, thinned to one point per voxel; columns,
/// sensors, metrics and errors are as register.gicp's header says.
RegisteredScans register_scans(const Inputs<Cloud>& clouds, const RegisterSettings& settings, const AlignPair& align,
                               Context& context);

/// One point per voxel: the mean.
Points thinned(const Points& points, double voxel, const Context& context);
Points moved(const Points& points, const Eigen::Isometry3d& motion);

/// How points lie to those of the tree: share with a neighbour within `reach`, and median and RMS distance of those.
struct Fitness {
  double overlap = 0, median = 0, rms = 0;
};
Fitness fitness_of(const Points& source, const PointTree& target, double reach);

}  // namespace atrium::registration
