#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "modules/building/ifc_context.hpp"
#include "modules/floorplan/regions.hpp"

namespace atrium::building {
namespace {

using floorplan::Region;
using step::choice, step::none, step::refs, step::text;

constexpr double least_boundary = 1e-3;  // square metres

/// Coordinates in a face's plane, as a space boundary wants them: the normal leads out of the room.
struct FacePlane {
  Eigen::Vector3d origin, out, across, up;

  FacePlane(const BuildingFace& face, const Eigen::Vector3d& at) : origin(at), out(-face.plane.normal.normalized()) {
    Eigen::Vector3d level(-out.y(), out.x(), 0);
    if (level.norm() < 1e-9) level = Eigen::Vector3d::UnitX();
    across = level.normalized();
    up = out.cross(across);
  }
  Eigen::Vector2d flat(const Eigen::Vector3d& p) const { return {across.dot(p - origin), up.dot(p - origin)}; }
  PlanRing flat(const std::vector<Eigen::Vector3d>& ring) const {
    PlanRing result;
    for (const auto& p : ring) result.push_back(flat(p));
    return result;
  }
};

class Boundaries {
 public:
  explicit Boundaries(IfcContext& ifc) : ifc_(ifc) {}

  void walls() {
    for (const auto& line : ifc_.elements.lines) {
      const BuildingFace& face = ifc_.face(line.face);
      if (face.room < 0) continue;
      const FacePlane plane = plane_of(face);
      const Region whole = region_of(face, plane);
      for (const auto& part : line.backing) {
        if (part.wall < 0) continue;
        const Wall& wall = ifc_.elements.walls[static_cast<std::size_t>(part.wall)];
        const bool inside = wall.left_room >= 0 && wall.right_room >= 0;
        add(face, plane, floorplan::common(whole, {{band(line, part, plane), {}}}),
            ifc_.walls[static_cast<std::size_t>(part.wall)], inside ? "INTERNAL" : "NOTDEFINED");
      }
    }
  }

  void slabs() {
    for (std::size_t s = 0; s < ifc_.elements.slabs.size(); ++s) {
      const Slab& slab = ifc_.elements.slabs[s];
      for (const auto f : slab.faces) {
        const BuildingFace& face = ifc_.face(f);
        if (face.room < 0) continue;
        const FacePlane plane = plane_of(face);
        const Eigen::Vector3d& n = face.plane.normal;
        const auto lifted = [&](const PlanRing& ring) {
          PlanRing result;
          for (const auto& p : ring) {
            const double z = plane.origin.z() - (n.head<2>().dot(p - plane.origin.head<2>())) / n.z();
            result.push_back(plane.flat(Eigen::Vector3d(p.x(), p.y(), z)));
          }
          return result;
        };
        Region own = region_of(face, plane);
        if (!slab.whole) {
          std::vector<PlanRing> holes;
          for (const auto& hole : slab.footprint.holes) holes.push_back(lifted(hole));
          own = floorplan::common(
              own, floorplan::minus(floorplan::united({lifted(slab.footprint.outline)}), floorplan::united(holes)));
        }
        add(face, plane, own, ifc_.slabs[s], slab.kind == SlabKind::between ? "INTERNAL" : "NOTDEFINED");
      }
    }
  }

  void columns() {
    for (std::size_t c = 0; c < ifc_.elements.columns.size(); ++c)
      for (const auto f : ifc_.elements.columns[c].faces) {
        const FacePlane plane = plane_of(ifc_.face(f));
        add(ifc_.face(f), plane, region_of(ifc_.face(f), plane), ifc_.columns[c], "INTERNAL");
      }
  }

  /// Doors and windows, and the openings that nothing fills.
  void openings() {
    for (const auto& hole : ifc_.holes) {
      const BuildingOpening& opening = ifc_.building.openings[static_cast<std::size_t>(hole.opening)];
      const bool inside = opening.room_a >= 0 && opening.room_b >= 0;
      const auto side = [&](std::int32_t f, const std::vector<Eigen::Vector3d>& outline) {
        if (f < 0 || outline.size() < 3 || ifc_.face(f).room < 0) return;
        const FacePlane plane = plane_of(ifc_.face(f));
        add(ifc_.face(f), plane, floorplan::united({plane.flat(outline)}), hole.fills ? hole.fills : hole.ref,
            inside ? "INTERNAL" : "NOTDEFINED", !hole.fills);
      };
      side(opening.face_a, opening.outline_a);
      side(opening.face_b, opening.outline_b);
    }
  }

 private:
  FacePlane plane_of(const BuildingFace& face) const { return {face, ifc_.building.vertices[face.outline.front()]}; }

  Region region_of(const BuildingFace& face, const FacePlane& plane) const {
    std::vector<PlanRing> rings;
    for (const auto& ring : ifc_.rings(face)) rings.push_back(plane.flat(ring));
    const Region outline = floorplan::united({rings.front()});
    rings.erase(rings.begin());
    return floorplan::minus(outline, floorplan::united(rings));
  }

  /// What of a face's plane lies between two places along its line.
  static PlanRing band(const FaceLine& line, const Backing& part, const FacePlane& plane) {
    constexpr double far = 1e3;  // metres: higher than any wall
    PlanRing ring;
    for (const double s : {part.from, part.to}) {
      const Eigen::Vector2d p = line.at(s);
      ring.push_back(plane.flat(Eigen::Vector3d(p.x(), p.y(), plane.origin.z())));
    }
    const double from = std::min(ring[0].x(), ring[1].x()), to = std::max(ring[0].x(), ring[1].x());
    return {{from, -far}, {to, -far}, {to, far}, {from, far}};
  }

  void add(const BuildingFace& face, const FacePlane& plane, const Region& region, StepRef element,
           std::string_view side, bool open = false) {
    for (const auto& polygon : region) {
      if (polygon.area() < least_boundary) continue;
      const StepRef base =
          ifc_.file.add("IFCPLANE", {ifc_.shapes.axes({local(plane.origin, face), plane.out, plane.across})});
      std::vector<StepRef> holes;
      for (const auto& hole : polygon.holes) holes.push_back(ifc_.shapes.polyline(hole, true));
      const StepRef surface =
          ifc_.file.add("IFCCURVEBOUNDEDPLANE", {base, ifc_.shapes.polyline(polygon.outline, true), refs(holes)});
      const StepRef geometry = ifc_.file.add("IFCCONNECTIONSURFACEGEOMETRY", {surface, none()});
      const auto f = static_cast<std::size_t>(&face - ifc_.building.faces.data());
      const std::string key = fmt::format("boundary of face {} part {}", f, parts_[f]++);
      ifc_.file.add("IFCRELSPACEBOUNDARY",
                    {ifc_.id(key), none(), text("1stLevel"), none(), ifc_.spaces[static_cast<std::size_t>(face.room)],
                     element, geometry, choice(open ? "VIRTUAL" : "PHYSICAL"), choice(side)});
    }
  }

  Eigen::Vector3d local(const Eigen::Vector3d& p, const BuildingFace& face) const {
    const BuildingRoom& room = ifc_.building.rooms[static_cast<std::size_t>(face.room)];
    return p - ifc_.elevation(room.storey) * Eigen::Vector3d::UnitZ();
  }

  IfcContext& ifc_;
  std::map<std::size_t, int> parts_;  ///< how many boundaries a face has so far
};

}  // namespace

void add_ifc_boundaries(IfcContext& ifc) {
  Boundaries boundaries(ifc);
  boundaries.walls();
  boundaries.slabs();
  boundaries.columns();
  boundaries.openings();
}

}  // namespace atrium::building
