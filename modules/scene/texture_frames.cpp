#include "modules/scene/texture_frames.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "modules/geometry/plane_frame.hpp"
#include "modules/geometry/polygon.hpp"

namespace atrium::scene {
namespace {

/// An upright image is kept unless the tightest one has less than this share of its area.
constexpr double tight_share = 0.7;

struct Face {
  Eigen::Vector3d area = Eigen::Vector3d::Zero();    // twice the vector area
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // sum of corners weighted by area
  double weight = 0;
  std::vector<Eigen::Vector3d> corners;
};

std::map<std::int32_t, Face> structural_faces(const Mesh& mesh) {
  std::map<std::int32_t, Face> faces;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.classes[t] == SurfaceClass::object || mesh.primitives[t] < 0) continue;
    const auto& [a, b, c] = mesh.triangles[t];
    const auto &p = mesh.vertices[a], &q = mesh.vertices[b], &r = mesh.vertices[c];
    Face& face = faces[mesh.primitives[t]];
    const Eigen::Vector3d area = (q - p).cross(r - p);
    face.area += area;
    face.centre += area.norm() * (p + q + r);
    face.weight += 3 * area.norm();
    face.corners.insert(face.corners.end(), {p, q, r});
  }
  return faces;
}

/// Turns u and v so that the box of the corners is smallest, by less than 45° and only where that saves much.
void turn_to_fit(PlaneFrame& frame, const std::vector<Eigen::Vector2d>& corners) {
  const Polygon2 hull = convex_hull(corners);
  if (hull.size() < 3) return;
  const Rectangle2 least = minimum_area_rectangle(hull);
  Eigen::AlignedBox2d box;
  for (const auto& p : hull) box.extend(p);
  if ((least.high - least.low).prod() > tight_share * box.volume()) return;
  Eigen::Vector2d axis = least.axis;
  if (std::abs(axis.x()) < std::abs(axis.y())) axis = least.perpendicular();
  if (axis.x() < 0) axis = -axis;
  const Eigen::Vector3d u = frame.u * axis.x() + frame.v * axis.y();
  frame.v = frame.v * axis.x() - frame.u * axis.y();
  frame.u = u;
}

/// With `across` and `down` as long as the rectangle of the corners.
FaceTexture rectangle_of(std::int32_t primitive, const Face& face) {
  const Eigen::Vector3d normal = face.area.normalized();
  const Eigen::Vector3d centre = face.centre / face.weight;
  PlaneFrame frame = upright_frame({normal, -normal.dot(centre)}, centre);
  std::vector<Eigen::Vector2d> flat;
  for (const auto& corner : face.corners) flat.push_back(frame.to_plane(corner));
  turn_to_fit(frame, flat);
  Eigen::AlignedBox2d box;
  for (const auto& corner : face.corners) box.extend(frame.to_plane(corner));
  FaceTexture image;
  image.primitive = primitive;
  image.corner = frame.to_space({box.min().x(), box.max().y()});
  image.across = frame.u * box.sizes().x();
  image.down = -frame.v * box.sizes().y();
  return image;
}

double pixels_of(const FaceTexture& image, double pixel, double max_side) {
  const double size = std::max(pixel, std::max(image.across.norm(), image.down.norm()) / max_side);
  return std::max(1.0, image.across.norm() / size) * std::max(1.0, image.down.norm() / size);
}

/// Rounds the rectangle up to whole pixels, about its middle.
void set_pixels(FaceTexture& image, double pixel) {
  constexpr double rounding = 1e-6;  // of a pixel: a side that fits exactly gets no pixel more
  const auto whole = [&](Eigen::Vector3d& side, std::int32_t& number) {
    const double length = side.norm();
    number = std::max(1, static_cast<std::int32_t>(std::ceil(length / pixel - rounding)));
    const double longer = std::max(number * pixel, length);
    image.corner -= side * ((longer / length - 1) / 2);
    side *= longer / length;
  };
  whole(image.across, image.width);
  whole(image.down, image.height);
}

}  // namespace

std::vector<FaceTexture> texture_frames(const Mesh& mesh, const TextureSize& size, const Context& context) {
  constexpr double least_area = 1e-6;  // square metres
  std::vector<FaceTexture> images;
  for (const auto& [primitive, face] : structural_faces(mesh))
    if (face.area.norm() > least_area) images.push_back(rectangle_of(primitive, face));
  double total = 0;
  for (const auto& image : images) total += pixels_of(image, size.pixel, size.max_side);
  double pixel = size.pixel;
  if (total > size.max_pixels) {
    while (total > size.max_pixels) {
      pixel *= std::max(1.001, std::sqrt(total / size.max_pixels));
      total = 0;
      for (const auto& image : images) total += pixels_of(image, pixel, size.max_side);
    }
    context.warn(fmt::format("pixels of {:.3g} m instead of {:.3g} m, so that the images have {:.0f} pixels at most",
                             pixel, size.pixel, size.max_pixels));
  }
  for (auto& image : images) {
    const double side = std::max(image.across.norm(), image.down.norm());
    const double own = std::max(pixel, side / size.max_side);
    if (own > pixel)
      context.warn(
          fmt::format("primitive {} is {:.1f} m long: its image has pixels of {:.3g} m, so that it is at most "
                      "{:.0f} pixels long",
                      image.primitive, side, own, size.max_side));
    set_pixels(image, own);
  }
  return images;
}

}  // namespace atrium::scene
