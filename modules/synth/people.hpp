#pragma once
#include <Eigen/Core>
#include <vector>

#include "modules/geometry/triangle_tree.hpp"
#include "modules/synth/stations.hpp"

namespace atrium::synth {

/// People who walk about while the scanner works: a body 1.6 m high and 0.44 m wide, and a head.
class People {
 public:
  /// Each of `count` people is there during half of the blocks of `block` stations, and walks straight from one place
  /// to another that the block's first station sees. `eye`: height of the scanner above the floor.
  People(std::size_t count, const std::vector<Station>& stations, std::size_t block, double eye,
         const TriangleTree& walls, Random random);

  /// How far along a ray of unit length somebody is hit; infinity: nobody. `share`: of the station's time that is over.
  double cast(const Eigen::Vector3d& from, const Eigen::Vector3d& direction, std::size_t station, double share) const;

 private:
  struct Person {
    Eigen::Vector3d start, end;  // feet
  };
  std::vector<std::vector<Person>> blocks_;
  std::size_t block_ = 1;
};

}  // namespace atrium::synth
