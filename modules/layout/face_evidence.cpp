#include "modules/layout/face_evidence.hpp"

#include <algorithm>
#include <cmath>

#include "modules/layout/raster.hpp"
#include "modules/layout/wall_pairs.hpp"

namespace atrium::layout {
namespace {

bool contains(const std::vector<Eigen::Vector3d>& outline, const Eigen::Vector3d& p) {
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector3d &a = outline[i], &b = outline[(i + 1) % outline.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y())) inside = !inside;
  }
  return inside;
}

/// What is less wide is no opening.
double least_width(const BuildingFace& face, const Openings::Params& params) {
  return face.surface == SurfaceClass::wall ? std::min(params.min_width, params.min_height) : params.min_slab_width;
}

}  // namespace

EvidenceFinder::EvidenceFinder(const Building& building, const Cloud& cloud, const Openings::Params& params)
    : building_(building), cloud_(cloud), params_(params), space_(cloud, params.pixel), seen_by_(cloud.sensors.size()) {
  for (std::size_t r = 0; r < building.rooms.size(); ++r) views_.push_back(view_of(static_cast<std::int32_t>(r)));
  if (seen_by_.empty()) return;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const std::size_t sensor = cloud.source.empty() ? 0 : cloud.source[i];
    if (sensor < seen_by_.size()) seen_by_[sensor].push_back(static_cast<std::uint32_t>(i));
  }
}

RoomView EvidenceFinder::view_of(std::int32_t index) const {
  constexpr double eye = 1.5, least_step = 0.7, most_places = 50;
  const BuildingRoom& room = building_.rooms[static_cast<std::size_t>(index)];
  RoomView view;
  if (room.outline.empty()) return view;
  const double floor = room.outline[0].z();
  for (std::size_t s = 0; s < cloud_.sensors.size(); ++s) {
    const Eigen::Vector3d p = cloud_.sensors[s].cast<double>();
    if (!contains(room.outline, p) || p.z() <= floor || p.z() >= floor + 2 * std::max(room.height, eye)) continue;
    view.places.push_back(p);
    view.sensors.push_back(s);
  }
  if (!view.places.empty()) return view;
  Eigen::AlignedBox3d box;
  for (const auto& p : room.outline) box.extend(p);
  const double step = std::max(least_step, std::sqrt(room.area / most_places));
  for (double y = box.min().y() + step / 2; y < box.max().y(); y += step)
    for (double x = box.min().x() + step / 2; x < box.max().x(); x += step) {
      const Eigen::Vector3d p(x, y, floor + std::min(eye, room.height / 2));
      if (contains(room.outline, p) && !space_.is_occupied(p)) view.places.push_back(p);
    }
  view.enough = std::max<std::size_t>(1, view.places.size() / 2);
  return view;
}

FaceEvidence EvidenceFinder::gather(std::size_t index) const {
  constexpr double depth = 1.0, noise_levels = 3;
  const BuildingFace& face = building_.faces[index];
  const bool wall = face.surface == SurfaceClass::wall;
  FaceEvidence evidence;
  if (views_[static_cast<std::size_t>(face.room)].places.empty()) return evidence;
  evidence.frame = upright_frame(face.plane, building_.vertices[face.outline[0]]);
  evidence.tolerance = std::clamp(noise_levels * face.residual, params_.tolerance, 2 * params_.tolerance);
  Eigen::AlignedBox2d box;
  Eigen::AlignedBox3d around;
  for (const auto v : face.outline) {
    const Eigen::Vector3d& p = building_.vertices[v];
    box.extend(evidence.frame.to_plane(p));
    around.extend(p + evidence.tolerance * face.plane.normal);
    around.extend(p - depth * face.plane.normal);
  }
  FaceMask& mask = evidence.mask = FaceMask(box, params_.pixel);
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x)
      if (face_contains(building_, face, evidence.frame.to_space(mask.centre(x, y)), 0)) mask.at(x, y) = Square::hidden;
  space_.each_point_in(around, [&](const Eigen::Vector3d& p) {
    const double distance = face.plane.signed_distance(p);
    if (distance > evidence.tolerance || distance < -depth) return;
    const Eigen::Vector2d at = evidence.frame.to_plane(p);
    if (!box.contains(at)) return;
    if (distance < -evidence.tolerance)
      evidence.behind.emplace_back(at.x(), at.y(), -distance);
    else if (!wall || at.y() > box.min().y() + evidence.tolerance)  // the floor's points do not close doors
      evidence.on.push_back(at);
  });
  evidence.ways_known = !views_[static_cast<std::size_t>(face.room)].sensors.empty();
  find_ways(face, evidence);
  const double least = least_width(face, params_);
  evidence.spacing = mask.cover(evidence.on, 0.5 * least);
  std::vector<Eigen::Vector2d> shown = evidence.through;
  if (!evidence.ways_known)
    for (const auto& p : evidence.behind) shown.emplace_back(p.head<2>());
  evidence.open = FaceMask(box, params_.pixel);
  evidence.open.fill({Eigen::Vector2i(0, 0), Eigen::Vector2i(mask.width() - 1, mask.height() - 1)}, Square::hidden);
  evidence.open.cover(shown, 0.5 * least);
  mask.drop_narrow(static_cast<int>((least - 2 * evidence.spacing) / mask.pixel()));
  return evidence;
}

void EvidenceFinder::find_ways(const BuildingFace& face, FaceEvidence& evidence) const {
  const Plane& plane = face.plane;
  const Eigen::AlignedBox2d& box = evidence.mask.box();
  for (const auto s : views_[static_cast<std::size_t>(face.room)].sensors) {
    const Eigen::Vector3d from = cloud_.sensors[s].cast<double>();
    const double before = plane.signed_distance(from);
    if (before <= evidence.tolerance) continue;
    for (const auto i : seen_by_[s]) {
      const Eigen::Vector3d to = cloud_.points[i].cast<double>();
      const double distance = plane.signed_distance(to);
      if (distance >= -evidence.tolerance) continue;
      const Eigen::Vector2d at = evidence.frame.to_plane(from + before / (before - distance) * (to - from));
      if (box.contains(at)) evidence.through.push_back(at);
    }
  }
}

void EvidenceFinder::look_through(std::size_t index, FaceEvidence& evidence) const {
  constexpr double grazing = 0.15;  // such views of a wall see nothing through it
  constexpr double blind = 0.5;     // metres around a scanner where its tripod, dust and false echoes are dense
  const BuildingFace& face = building_.faces[index];
  const RoomView& view = views_[static_cast<std::size_t>(face.room)];
  FaceMask& mask = evidence.mask;
  const Eigen::Vector3d& normal = face.plane.normal;
  const Eigen::Vector3d off = (evidence.tolerance + evidence.spacing + 2 * params_.pixel) * normal;
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x) {
      if (mask.at(x, y) != Square::hidden) continue;
      if (evidence.ways_known && evidence.open.at(x, y) == Square::solid) {
        mask.at(x, y) = Square::hole;
        continue;
      }
      const Eigen::Vector3d p = evidence.frame.to_space(mask.centre(x, y)) + off;
      std::size_t seen = 0;
      for (std::size_t i = 0; i < view.places.size() && seen + view.places.size() - i >= view.enough; ++i) {
        const Eigen::Vector3d& place = view.places[i];
        const Eigen::Vector3d way = place - p;
        if (way.dot(normal) < grazing * way.norm() ||
            !space_.is_free(p, place - way * std::min(1.0, blind / way.norm())))
          continue;
        if (++seen >= view.enough) break;
      }
      if (seen >= view.enough) mask.at(x, y) = Square::hole;
    }
}

}  // namespace atrium::layout
