#include "modules/layout/objects.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "modules/geometry/plane_frame.hpp"
#include "modules/types/building_rules.hpp"

namespace atrium::layout {
namespace {

using Rings = std::vector<std::vector<Eigen::Vector2d>>;

/// Whether a place is within the rings (even, odd), and how far it is from them.
struct Against {
  bool inside = false;
  double distance = 1e300;
};
Against against(const Rings& rings, const Eigen::Vector2d& p) {
  Against result;
  for (const auto& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d &a = ring[i], d = ring[(i + 1) % ring.size()] - a;
      if ((a.y() > p.y()) != (a.y() + d.y() > p.y()) && p.x() < a.x() + d.x() * (p.y() - a.y()) / d.y())
        result.inside = !result.inside;
      const double along = d.squaredNorm() > 0 ? std::clamp(d.dot(p - a) / d.squaredNorm(), 0.0, 1.0) : 0;
      result.distance = std::min(result.distance, (a + along * d - p).norm());
    }
  return result;
}

Eigen::AlignedBox3d grown(const Eigen::AlignedBox3d& box, double by) {
  return {box.min() - Eigen::Vector3d::Constant(by), box.max() + Eigen::Vector3d::Constant(by)};
}

/// A polygon in space, and what is near it.
struct Slab {
  PlaneFrame frame;
  Rings rings;  // in the frame
  double below = 0, above = 0;
  double aside = 0;
  Eigen::AlignedBox3d box;  // of all places that can be near

  bool holds(const Eigen::Vector3d& p) const {
    if (!box.contains(p)) return false;
    const double height = frame.u.cross(frame.v).dot(p - frame.origin);
    if (height < -below || height > above) return false;
    const Against there = against(rings, frame.to_plane(p));
    return there.inside || there.distance <= aside;
  }
};

Slab slab_of(const Plane& plane, const std::vector<std::vector<Eigen::Vector3d>>& rings, double below, double above,
             double aside) {
  Slab slab{upright_frame(plane, rings[0][0]), {}, below, above, aside, {}};
  for (const auto& ring : rings) {
    slab.rings.emplace_back();
    for (const auto& p : ring) {
      slab.rings.back().push_back(slab.frame.to_plane(p));
      slab.box.extend(p - below * plane.normal);
      slab.box.extend(p + above * plane.normal);
    }
  }
  slab.box = grown(slab.box, aside);
  return slab;
}

/// A room, to tell what is inside: the way up leaves through an odd number of its floors and ceilings.
struct RoomSpace {
  Eigen::AlignedBox3d box;
  std::vector<std::size_t> levels;  // faces that are not upright
};

class Sorting {
 public:
  Sorting(const Building& building, const Objects::Params& params)
      : building_(building), params_(params), rooms_(building.rooms.size()) {
    for (const auto& face : building.faces) {
      std::vector<std::vector<Eigen::Vector3d>> rings{places(face.outline)};
      for (const auto& hole : face.holes) rings.push_back(places(hole));
      faces_.push_back(slab_of(plane_of(face, rings[0]), rings, params.distance, params.distance, params.distance));
      add_to_room(face);
    }
    for (const auto& opening : building.openings) add_reveal(opening);
  }

  bool is_object(const Eigen::Vector3d& p) const {
    const auto holds = [&](const Slab& slab) { return slab.holds(p); };
    return in_a_room(p) && std::none_of(faces_.begin(), faces_.end(), holds) &&
           std::none_of(reveals_.begin(), reveals_.end(), holds);
  }

 private:
  std::vector<Eigen::Vector3d> places(const std::vector<std::uint32_t>& ring) const {
    std::vector<Eigen::Vector3d> result;
    result.reserve(ring.size());
    for (const auto v : ring) result.push_back(building_.vertices[v]);
    return result;
  }
  /// That of its corners: an inferred face may have no plane of its own.
  static Plane plane_of(const BuildingFace& face, const std::vector<Eigen::Vector3d>& ring) {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) normal += (ring[i] - ring[0]).cross(ring[i + 1] - ring[0]);
    normal = normal.norm() > 0 ? normal.normalized() : face.plane.normal;
    return {normal, -normal.dot(ring[0])};
  }

  void add_to_room(const BuildingFace& face) {
    if (face.room < 0) return;
    RoomSpace& room = rooms_[static_cast<std::size_t>(face.room)];
    for (const auto v : face.outline) room.box.extend(building_.vertices[v]);
    // A way up crosses whatever is not upright, walls that lean as well.
    constexpr double upright = 1e-3;  // sine of the angle; corners of files are rounded
    const PlaneFrame& frame = faces_.back().frame;
    if (face.surface == SurfaceClass::wall && std::abs(frame.u.cross(frame.v).z()) < upright) return;
    room.levels.push_back(levels_.size());
    levels_.push_back({{}, faces_.back().frame});
    const auto flat = [&](const std::vector<std::uint32_t>& ring) {
      levels_.back().rings.emplace_back();
      for (const auto v : ring) levels_.back().rings.back().push_back(building_.vertices[v].head<2>());
    };
    flat(face.outline);
    for (const auto& hole : face.holes) flat(hole);
  }

  void add_reveal(const BuildingOpening& opening) {
    if (opening.outline_a.size() < 3 || opening.face_a < 0) return;
    const Plane plane = plane_of(building_.faces[static_cast<std::size_t>(opening.face_a)], opening.outline_a);
    const double depth = opening.thickness > 0 ? opening.thickness : params_.reveal_depth;
    reveals_.push_back(
        slab_of(plane, {opening.outline_a}, depth + params_.distance, params_.distance, params_.distance));
  }

  bool in_a_room(const Eigen::Vector3d& p) const {
    return std::any_of(rooms_.begin(), rooms_.end(), [&](const RoomSpace& room) {
      if (room.levels.empty() || !grown(room.box, params_.reach).contains(p)) return false;
      if (is_inside(room, p)) return true;
      if (!(params_.reach > 0)) return false;
      return std::any_of(room.levels.begin(), room.levels.end(), [&](std::size_t l) {
        const Against there = against(levels_[l].rings, p.head<2>());
        return there.inside || there.distance <= params_.reach;
      });
    });
  }
  bool is_inside(const RoomSpace& room, const Eigen::Vector3d& p) const {
    bool inside = false;  // a way straight up leaves the room through an odd number of its faces
    for (const auto l : room.levels) {
      const Level& level = levels_[l];
      const Eigen::Vector3d normal = level.frame.u.cross(level.frame.v);
      const bool above = normal.dot(p - level.frame.origin) * normal.z() < 0;
      if (above && against(level.rings, p.head<2>()).inside) inside = !inside;
    }
    return inside;
  }

  struct Level {
    Rings rings;  // seen from above
    PlaneFrame frame;
  };

  const Building& building_;
  const Objects::Params& params_;
  std::vector<RoomSpace> rooms_;
  std::vector<Level> levels_;
  std::vector<Slab> faces_, reveals_;
};

}  // namespace

Objects::Out Objects::run(const In& in, const Params& params, Context& context) {
  const Cloud& cloud = *in.structure->primitives->cloud;
  check(*in.building);
  const Sorting sorting(*in.building, params);
  const Eigen::Vector3d shift = cloud.origin - in.building->origin;
  constexpr std::size_t chunk_size = 16384;
  std::vector<std::vector<std::uint32_t>> chunks((cloud.size() + chunk_size - 1) / chunk_size);
  context.parallel_chunks(cloud.size(), chunk_size, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (sorting.is_object(cloud.points[i].cast<double>() + shift))
        chunks[chunk].push_back(static_cast<std::uint32_t>(i));
  });
  std::vector<std::uint32_t> kept;
  for (const auto& chunk : chunks) kept.insert(kept.end(), chunk.begin(), chunk.end());
  context.info(fmt::format("{} of {} points belong to objects", kept.size(), cloud.size()));
  return {select(cloud, kept)};
}

}  // namespace atrium::layout
