#include "modules/layout/face_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "modules/geometry/quantile.hpp"
#include "modules/layout/closed_leaves.hpp"
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

/// Finds the squares that points behind the face show through, knowing how many such points are strays.
void open_up(FaceEvidence& evidence, double farthest) {
  constexpr double clear = 1;  // strays within reach of a point, where six cover a square
  const FaceMask& mask = evidence.mask;
  const Eigen::AlignedBox2i all(Eigen::Vector2i(0, 0), Eigen::Vector2i(mask.width() - 1, mask.height() - 1));
  std::size_t strays = 0;
  const FaceMask inner = mask.eroded(evidence.spacing + mask.pixel());
  for (const auto& p : evidence.through) strays += inner.at(p) == Square::solid ? 1 : 0;
  const std::size_t solid = inner.count(all, Square::solid);
  evidence.stray = solid > 0 ? static_cast<double>(strays) / static_cast<double>(solid) : 0;
  if (evidence.stray > 0) farthest = std::min(farthest, 0.5 * (std::sqrt(clear / evidence.stray) - 1) * mask.pixel());
  evidence.open = FaceMask(mask.box(), mask.pixel());
  evidence.open.fill(all, Square::hidden);
  evidence.open.cover(evidence.through, std::max(farthest, 0.0));
}

/// How far behind a face the next surface begins, whether it is a face of the building or not: where points stand
/// behind the solid part of the face.
double depth_of_next(const FaceEvidence& evidence) {
  constexpr double slab = 0.02, least = 0.05;  // metres; of the face's own points
  constexpr std::size_t strays = 20, slabs = 50;
  const FaceMask inner = evidence.mask.eroded(evidence.spacing + evidence.mask.pixel());
  std::vector<std::size_t> counts(slabs, 0);
  for (const auto& p : evidence.behind)
    if (const auto i = static_cast<std::size_t>(p.z() / slab); i < slabs && inner.at(p.head<2>()) == Square::solid)
      ++counts[i];
  const auto all = static_cast<std::size_t>(least * static_cast<double>(evidence.on.size()));
  for (std::size_t i = 0; i + 1 < slabs; ++i)
    if (counts[i] + counts[i + 1] >= std::max(strays, all)) return slab * static_cast<double>(i);
  return slab * static_cast<double>(slabs);
}

/// The building and as much around it as its faces look behind themselves.
Eigen::AlignedBox3d around(const Building& building, const Openings::Params& params) {
  Eigen::AlignedBox3d box;
  for (const auto& v : building.vertices) box.extend(v);
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(2 * depth_behind(params));
  return {box.min() - margin, box.max() + margin};
}

}  // namespace

double depth_behind(const Openings::Params& params) {
  constexpr double beyond = 0.4;
  return params.max_thickness + beyond;
}

EvidenceFinder::EvidenceFinder(const Building& building, const Cloud& cloud, const Openings::Params& params)
    : building_(building),
      cloud_(cloud),
      params_(params),
      space_(cloud, params.pixel, around(building, params)),
      seen_by_(cloud.sensors.size()) {
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
  double ceiling = floor + eye;
  for (const auto f : room.faces)
    for (const auto v : building_.faces[static_cast<std::size_t>(f)].outline)
      ceiling = std::max(ceiling, building_.vertices[v].z());
  for (std::size_t s = 0; s < cloud_.sensors.size(); ++s) {
    const Eigen::Vector3d p = cloud_.sensors[s].cast<double>();
    if (p.z() <= floor || p.z() >= ceiling || !contains(room.outline, p)) continue;
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
  return view;
}

double EvidenceFinder::noise_of(const BuildingFace& face) const {
  constexpr double per_median = 1.4826;  // of a normal distribution
  std::vector<double> distances;
  Eigen::AlignedBox3d around;
  const double reach = 3 * face.residual;
  for (const auto v : face.outline) {
    around.extend(building_.vertices[v] + reach * face.plane.normal);
    around.extend(building_.vertices[v] - reach * face.plane.normal);
  }
  space_.each_point_in(around, [&](const Eigen::Vector3d& p) {
    const double distance = std::abs(face.plane.signed_distance(p));
    if (distance <= reach && around.contains(p)) distances.push_back(distance);
  });
  if (distances.empty()) return face.residual;
  return std::min(face.residual, per_median * median(std::move(distances)));
}

namespace {

/// Whether so much of a face was seen that holes in it mean anything.
bool is_seen(const FaceMask& mask) {
  constexpr double least = 0.05;
  const Eigen::AlignedBox2i all(Eigen::Vector2i(0, 0), Eigen::Vector2i(mask.width() - 1, mask.height() - 1));
  const auto solid = static_cast<double>(mask.count(all, Square::solid));
  return solid > least * (solid + static_cast<double>(mask.count(all, Square::hidden)));
}

}  // namespace

FaceEvidence EvidenceFinder::gather(std::size_t index) const {
  constexpr double noise_levels = 3;
  const BuildingFace& face = building_.faces[index];
  FaceEvidence evidence;
  if (face.room < 0) return evidence;
  const RoomView& view = views_[static_cast<std::size_t>(face.room)];
  if (view.places.empty()) return evidence;
  evidence.frame = upright_frame(face.plane, building_.vertices[face.outline[0]]);
  const double noise = noise_levels * noise_of(face);
  evidence.tolerance = std::clamp(noise, params_.tolerance, 2 * params_.tolerance);
  // The reveals of a door in a thin wall lie between its faces: points there are not all on one of them.
  const double thickness = thickness_at(index);
  if (thickness < params_.max_thickness)
    evidence.tolerance = std::min(evidence.tolerance, std::max(thickness / 3, noise));
  evidence.ways_known = !view.sensors.empty();
  Eigen::AlignedBox2d box;
  for (const auto v : face.outline) box.extend(evidence.frame.to_plane(building_.vertices[v]));
  constexpr double most_squares = 1 << 22;  // of larger faces the squares are larger
  FaceMask& mask = evidence.mask = FaceMask(box, std::max(params_.pixel, std::sqrt(box.sizes().prod() / most_squares)));
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x)
      if (face_contains(building_, face, evidence.frame.to_space(mask.centre(x, y)), 0)) mask.at(x, y) = Square::hidden;
  collect_points(face, evidence);
  // What lies on the wall's other face was seen from there: where furniture hides this one, it is no leaf.
  constexpr double other_face = 0.03;
  if (thickness < params_.max_thickness)
    std::erase_if(evidence.near, [&](const Eigen::Vector3f& p) { return -p.z() > thickness - other_face; });
  const double least = least_width(face, params_);
  evidence.spacing = mask.cover(evidence.on, 0.5 * least);
  if (!is_seen(mask)) return {};
  if (evidence.ways_known)
    find_ways(face, evidence);
  else
    find_body(index, evidence);
  open_up(evidence, 0.5 * least);
  mask.drop_narrow(static_cast<int>((least - 2 * evidence.spacing) / mask.pixel()));
  return evidence;
}

void EvidenceFinder::collect_points(const BuildingFace& face, FaceEvidence& evidence) const {
  const double step = face.surface == SurfaceClass::wall ? 0.2 : 0;  // metres that a floor outside may lie lower
  Eigen::AlignedBox3d around;
  for (const auto v : face.outline) {
    around.extend(building_.vertices[v] + std::max(evidence.tolerance, leaf_before) * face.plane.normal);
    around.extend(building_.vertices[v] - depth_behind(params_) * face.plane.normal);
  }
  around.min().z() -= step;
  const Eigen::AlignedBox2d& box = evidence.mask.box();
  const Eigen::AlignedBox2d below(box.min() - Eigen::Vector2d(0, step), Eigen::Vector2d(box.max().x(), box.min().y()));
  // The floor's points do not close doors.
  const bool wall = face.surface == SurfaceClass::wall;
  const double foot = wall ? box.min().y() + evidence.tolerance : box.min().y();
  space_.each_point_in(around, [&](const Eigen::Vector3d& p) {
    const double distance = face.plane.signed_distance(p);
    if (distance > std::max(evidence.tolerance, leaf_before) || distance < -depth_behind(params_)) return;
    const Eigen::Vector2d at = evidence.frame.to_plane(p);
    if (wall && distance <= leaf_before && distance >= -leaf_behind && box.contains(at))
      evidence.near.emplace_back(Eigen::Vector3d(at.x(), at.y(), distance).cast<float>());
    if (distance > evidence.tolerance) return;
    if (!box.contains(at)) {
      if (distance < -evidence.tolerance && below.contains(at)) evidence.lower.emplace_back(at.x(), at.y(), -distance);
      return;
    }
    if (distance < -evidence.tolerance)
      evidence.behind.emplace_back(at.x(), at.y(), -distance);
    else if (at.y() >= foot)
      evidence.on.push_back(at);
  });
}

double EvidenceFinder::thickness_at(std::size_t index) const {
  double thickness = params_.max_thickness;
  for (const auto& wall : building_.walls)
    if (wall.face_a == static_cast<std::int32_t>(index) || wall.face_b == static_cast<std::int32_t>(index))
      thickness = std::min(thickness, wall.thickness);
  return thickness;
}

/// Points between the face and the next surface behind it; none can be in a solid wall.
void EvidenceFinder::find_body(std::size_t index, FaceEvidence& evidence) const {
  double thickness = thickness_at(index);
  if (thickness < params_.max_thickness)
    thickness -= 0.5 * evidence.tolerance;
  else
    thickness = std::min(thickness, depth_of_next(evidence));
  for (const auto& p : evidence.behind)
    if (p.z() < thickness) evidence.through.emplace_back(p.head<2>());
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
  if (!evidence.looked_at()) return;
  const BuildingFace& face = building_.faces[index];
  const RoomView& view = views_[static_cast<std::size_t>(face.room)];
  FaceMask& mask = evidence.mask;
  const Eigen::Vector3d& normal = face.plane.normal;
  const Eigen::Vector3d off = std::max(evidence.tolerance + evidence.spacing, 2 * params_.pixel) * normal;
  std::vector<Eigen::Vector3d> ways;
  const auto is_seen = [&](int x, int y) {
    const Eigen::Vector3d p = evidence.frame.to_space(mask.centre(x, y)) + off;
    ways.clear();
    for (const auto& place : view.places)
      if (const Eigen::Vector3d way = place - p; way.dot(normal) >= grazing * way.norm()) ways.push_back(way);
    const std::size_t enough = evidence.ways_known ? 1 : std::max<std::size_t>(1, ways.size() / 4);
    std::size_t seen = 0;
    for (std::size_t i = 0; i < ways.size() && seen + ways.size() - i >= enough; ++i) {
      const double spared = evidence.ways_known ? std::min(1.0, blind / ways[i].norm()) : 0;
      if (space_.is_free(p, p + (1 - spared) * ways[i]) && ++seen >= enough) return true;
    }
    return false;
  };
  // One way for each block of squares.
  constexpr int block = 2;
  for (int y0 = 0; y0 < mask.height(); y0 += block)
    for (int x0 = 0; x0 < mask.width(); x0 += block) {
      std::optional<bool> seen;
      for (int y = y0; y < std::min(y0 + block, mask.height()); ++y)
        for (int x = x0; x < std::min(x0 + block, mask.width()); ++x) {
          if (mask.at(x, y) != Square::hidden) continue;
          const bool open = evidence.open.at(x, y) == Square::solid;
          if (!open && !seen) seen = is_seen(x, y);
          if (open || *seen) mask.at(x, y) = Square::hole;
        }
    }
}

}  // namespace atrium::layout
