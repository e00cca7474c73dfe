#include "modules/layout/slopes_left_out.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "modules/geometry/plane_frame.hpp"
#include "modules/layout/raster.hpp"

namespace atrium::layout {
namespace {

constexpr double slope_square = 0.1;      // metres
constexpr double least_slope_area = 2;    // slope_square metres
constexpr double least_slope_height = 1;  // metres
constexpr double near_face = 0.15;        // metres
constexpr double near_room = 0.5;         // metres
constexpr double along_face = 0.94;       // cosine of 20 degrees

Eigen::AlignedBox3d box_around(const Building& building, const BuildingFace& face, double margin) {
  Eigen::AlignedBox3d box;
  for (const auto v : face.outline) box.extend(building.vertices[v]);
  const Eigen::Vector3d around = Eigen::Vector3d::Constant(margin);
  return {box.min() - around, box.max() + around};
}

class FaceBoxes {
 public:
  explicit FaceBoxes(const Building& building) : building_(building) {
    for (const auto& face : building.faces) boxes_.push_back(box_around(building, face, near_face));
    for (const auto& room : building.rooms) {
      Eigen::AlignedBox3d box;
      for (const auto f : room.faces)
        box.extend(box_around(building, building.faces[static_cast<std::size_t>(f)], near_room));
      rooms_.push_back(box);
    }
  }
  bool in_room(const Eigen::Vector3d& p) const {
    return std::any_of(rooms_.begin(), rooms_.end(), [&](const auto& box) { return box.contains(p); });
  }
  bool on_face(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) const {
    for (std::size_t f = 0; f < boxes_.size(); ++f) {
      const Plane& plane = building_.faces[f].plane;
      if (boxes_[f].contains(p) && std::abs(plane.signed_distance(p)) < near_face &&
          std::abs(plane.normal.dot(normal)) > along_face)
        return true;
    }
    return false;
  }

 private:
  const Building& building_;
  std::vector<Eigen::AlignedBox3d> boxes_, rooms_;
};

}  // namespace

SlopesLeftOut slopes_left_out(const Building& building, const PlanePrimitives& planes) {
  SlopesLeftOut result;
  const FaceBoxes faces(building);
  for (const auto& primitive : planes.primitives) {
    if (is_upright(primitive.plane) || is_level(primitive.plane)) continue;
    const PlaneFrame frame = upright_frame(primitive.plane, Eigen::Vector3d::Zero());
    std::unordered_map<std::uint64_t, Eigen::Vector3d> squares;  // one point of each
    for (const auto i : primitive.inliers) {
      const Eigen::Vector3d p = planes.cloud->points[i].cast<double>();
      const Eigen::Vector2d at = (frame.to_plane(p) / slope_square).array().floor();
      squares.emplace(static_cast<std::uint64_t>(static_cast<std::uint32_t>(static_cast<std::int32_t>(at.x()))) << 32U |
                          static_cast<std::uint32_t>(static_cast<std::int32_t>(at.y())),
                      p);
    }
    if (static_cast<double>(squares.size()) * slope_square * slope_square < least_slope_area) continue;
    Eigen::AlignedBox3d left;
    std::size_t count = 0;
    for (const auto& [key, p] : squares) {
      if (!faces.in_room(p) || faces.on_face(p, primitive.plane.normal)) continue;
      left.extend(p);
      ++count;
    }
    const double area = static_cast<double>(count) * slope_square * slope_square;
    if (area < least_slope_area || left.sizes().z() < least_slope_height) continue;
    result.area += area;
    if (area <= result.largest) continue;
    result.largest = area;
    result.where = left.center();
  }
  return result;
}

}  // namespace atrium::layout
