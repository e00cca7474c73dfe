#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "graph/api/random.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::test {

/// A rectangle in space with rectangular holes, sampled on the side that its normal points to.
struct Face {
  using Rectangle = std::array<double, 4>;  ///< low u, low v, high u, high v
  Eigen::Vector3d corner, u, v;             ///< u and v: edges; normal = u × v
  std::vector<Rectangle> holes;             ///< metres along u and v
  bool structural = true;                   ///< wall, floor or ceiling

  Eigen::Vector3d normal() const { return u.cross(v).normalized(); }
  double area() const {
    double a = u.norm() * v.norm();
    for (const auto& [u0, v0, u1, v1] : holes) a -= (u1 - u0) * (v1 - v0);
    return a;
  }
  bool in_hole(double s, double t) const {
    return std::any_of(holes.begin(), holes.end(),
                       [&](const Rectangle& h) { return s > h[0] && s < h[2] && t > h[1] && t < h[3]; });
  }
};

struct Sampling {
  std::size_t points = 100000;
  double noise = 0.008;      ///< standard deviation along each axis, metres
  double outliers = 0.01;    ///< share of points anywhere in the bounding box
  double normal_error = 15;  ///< standard deviation of the normals' tilt about each axis, degrees
  std::uint64_t seed = 1;
  bool normals = true;
};

/// Points uniformly over the faces; labels are the face's index, -1 for outliers.
inline Cloud sample(const std::vector<Face>& faces, const Sampling& sampling) {
  Random random(sampling.seed);
  std::vector<double> cumulative;
  double total = 0;
  Eigen::AlignedBox3d box;
  for (const Face& f : faces) {
    cumulative.push_back(total += f.area());
    for (const Eigen::Vector3d& p : {f.corner, Eigen::Vector3d(f.corner + f.u + f.v)}) box.extend(p);
  }
  const auto noise = [&](double sigma) -> Eigen::Vector3d {
    return Eigen::Vector3d(random.normal(), random.normal(), random.normal()) * sigma;
  };
  Cloud cloud;
  while (cloud.size() < sampling.points) {
    Eigen::Vector3d p, n;
    std::int32_t label = -1;
    if (random.uniform() < sampling.outliers) {
      for (int i = 0; i < 3; ++i) p[i] = random.uniform(box.min()[i], box.max()[i]);
      n = noise(1).normalized();
    } else {
      const auto k = static_cast<std::size_t>(
          std::upper_bound(cumulative.begin(), cumulative.end(), random.uniform() * total) - cumulative.begin());
      const Face& f = faces[std::min(k, faces.size() - 1)];
      double s = 0;
      double t = 0;
      do {
        s = random.uniform(0, f.u.norm());
        t = random.uniform(0, f.v.norm());
      } while (f.in_hole(s, t));
      p = f.corner + f.u.normalized() * s + f.v.normalized() * t + noise(sampling.noise);
      n = (f.normal() + noise(std::tan(sampling.normal_error * M_PI / 180))).normalized();
      label = static_cast<std::int32_t>(k);
    }
    cloud.points.push_back(p.cast<float>());
    if (sampling.normals) cloud.normals.push_back(n.cast<float>());
    cloud.labels.push_back(label);
  }
  return cloud;
}

/// The six faces of a box seen from within (a room) or from without (furniture).
inline std::vector<Face> box_faces(const Eigen::Vector3d& low, const Eigen::Vector3d& high, bool from_within) {
  const Eigen::Vector3d d = high - low;
  const Eigen::Vector3d x(d.x(), 0, 0), y(0, d.y(), 0), z(0, 0, d.z());
  std::vector<Face> faces{{low, x, y, {}, true},     {low + z, y, x, {}, true}, {low, y, z, {}, true},
                          {low + x, z, y, {}, true}, {low, z, x, {}, true},     {low + y, x, z, {}, true}};
  if (from_within) return faces;
  for (Face& f : faces) {
    std::swap(f.u, f.v);
    f.structural = false;
  }
  return faces;
}

/// A flat of 2 × 2 rooms, 10 × 8 m, inner walls of 12 cm with doors, outer walls with windows, furniture. The doors'
/// reveals are faces of 12 cm.
inline std::vector<Face> furnished_flat() {
  constexpr double height = 2.6;
  constexpr double half_wall = 0.06;
  constexpr double width = 10;
  constexpr double depth = 8;
  const double xs[2][2] = {{0, 5.5 - half_wall}, {5.5 + half_wall, width}};
  const double ys[2][2] = {{0, 4.5 - half_wall}, {4.5 + half_wall, depth}};
  std::vector<Face> faces;
  const auto furniture = [&](Eigen::Vector3d low, Eigen::Vector3d size) {
    std::vector<Face> box = box_faces(low, low + size, false);
    box.erase(box.begin());  // nobody sees it from below
    faces.insert(faces.end(), box.begin(), box.end());
  };
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      std::vector<Face> room = box_faces({xs[i][0], ys[j][0], 0}, {xs[i][1], ys[j][1], height}, true);
      // Faces 2 and 3 are the walls at low and high x, 4 and 5 those at low and high y. Face 2 runs (y, z), 3 (z, y),
      // 4 (z, x), 5 (x, z).
      Face& inner_x = room[i == 0 ? 3 : 2];
      Face& outer_x = room[i == 0 ? 2 : 3];
      Face& inner_y = room[j == 0 ? 5 : 4];
      Face& outer_y = room[j == 0 ? 4 : 5];
      inner_x.holes.push_back(i == 0 ? Face::Rectangle{0, 1, 2, 1.9} : Face::Rectangle{1, 0, 1.9, 2});
      inner_y.holes.push_back(j == 0 ? Face::Rectangle{2, 0, 2.9, 2} : Face::Rectangle{0, 2, 2, 2.9});
      outer_x.holes.push_back(i == 0 ? Face::Rectangle{1, 0.9, 2.5, 2.1} : Face::Rectangle{0.9, 1, 2.1, 2.5});
      outer_y.holes.push_back(j == 0 ? Face::Rectangle{0.9, 1, 2.1, 3} : Face::Rectangle{1, 0.9, 3, 2.1});
      faces.insert(faces.end(), room.begin(), room.end());
      const double x = xs[i][0];
      const double y = ys[j][0];
      furniture({x + 2.2, y + 1.2, 0}, {1.4, 0.8, 0.74});  // table
      furniture({x + 0.01, y + 2.4, 0}, {0.6, 0.8, 1.9});  // wardrobe at the wall, which hides its back
      faces.erase(faces.end() - 4);
      furniture({x + 3.2, y + 2.4, 0}, {0.9, 0.7, 0.45});  // chest
      furniture({x + 1.0, y + 0.3, 0}, {0.5, 0.4, 0.9});   // shelf
    }
  return faces;
}

/// How well primitives match labelled faces.
struct FaceMatch {
  std::size_t face = 0;
  std::size_t points = 0;  ///< of the face
  double best_iou = 0;     ///< of the face's points and the inliers of one primitive
  int primitive = -1;
  double angle = 0;   ///< between the normals, degrees
  double offset = 0;  ///< distance of the face's centre from the primitive's plane, metres
};

inline std::vector<FaceMatch> match_faces(const std::vector<Face>& faces, const PlanePrimitives& planes) {
  std::vector<FaceMatch> matches(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) matches[f].face = f;
  for (const std::int32_t label : planes.cloud->labels)
    if (label >= 0) ++matches[static_cast<std::size_t>(label)].points;
  for (std::size_t k = 0; k < planes.primitives.size(); ++k) {
    const PlanePrimitive& p = planes.primitives[k];
    std::vector<std::size_t> shared(faces.size(), 0);
    for (const std::uint32_t i : p.inliers)
      if (planes.cloud->labels[i] >= 0) ++shared[static_cast<std::size_t>(planes.cloud->labels[i])];
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const auto both = static_cast<double>(shared[f]);
      const double iou = both / (static_cast<double>(matches[f].points + p.inliers.size()) - both);
      if (iou <= matches[f].best_iou) continue;
      matches[f].best_iou = iou;
      matches[f].primitive = static_cast<int>(k);
      const double cosine = std::clamp(p.plane.normal.dot(faces[f].normal()), -1.0, 1.0);
      matches[f].angle = std::acos(cosine) * 180 / M_PI;
      matches[f].offset = std::abs(p.plane.signed_distance(faces[f].corner + 0.5 * (faces[f].u + faces[f].v)));
    }
  }
  return matches;
}

}  // namespace atrium::test
