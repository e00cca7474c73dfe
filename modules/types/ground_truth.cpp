#include "modules/types/ground_truth.hpp"

#include <Eigen/Geometry>

namespace atrium {

Eigen::Vector3d area_vector(const std::vector<Eigen::Vector3d>& ring) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 2; i < ring.size(); ++i) sum += (ring[i - 1] - ring[0]).cross(ring[i] - ring[0]);
  return sum / 2;
}

double TrueFace::area() const {
  double sum = area_vector(outline).norm();
  for (const auto& hole : holes) sum -= area_vector(hole).norm();
  return sum;
}

GroundTruth transformed(const GroundTruth& truth, const Transform& transform) {
  GroundTruth result = truth;
  result.origin = transform.rotation * truth.origin + transform.translation;
  const auto turn = [&](std::vector<Eigen::Vector3d>& ring) {
    for (auto& p : ring) p = transform.rotation * p;
  };
  for (auto& face : result.faces) {
    face.plane.normal = (transform.rotation * face.plane.normal).normalized();
    turn(face.outline);
    for (auto& hole : face.holes) turn(hole);
  }
  for (auto& opening : result.openings) turn(opening.outline);
  for (auto& room : result.rooms) turn(room.outline);
  result.mesh = transformed(truth.mesh, transform);
  return result;
}

}  // namespace atrium
