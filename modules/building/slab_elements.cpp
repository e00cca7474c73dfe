#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "modules/building/element_steps.hpp"

namespace atrium::building {
namespace {

constexpr double one_plane = 0.003;       // metres: faces this near to a plane lie on it
constexpr double on_slab = 0.01;          // metres: walls that end this near to a slab end at it
constexpr double slab_reach = 0.005;      // metres
constexpr double least_slab = 0.01;       // square metres: smaller leftovers are none
constexpr double least_common = 0.05;     // square metres: of a floor over a ceiling
constexpr double least_thickness = 0.02;  // metres of a slab between storeys
constexpr double steep = 0.05;            // least upright part of a unit normal

/// Faces of one class in one plane on a storey, as an area seen from above.
struct Plate {
  SurfaceClass surface = SurfaceClass::floor;
  std::int32_t storey = 0;
  std::vector<std::int32_t> faces;
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();  ///< z = plane · (x, y, 1)
  Region region;
  std::vector<Region> parts;  ///< of each face, a little larger: what touches them

  bool level() const { return plane.x() == 0 && plane.y() == 0; }
  double at(const Eigen::Vector2d& p) const { return plane.x() * p.x() + plane.y() * p.y() + plane.z(); }
};

Eigen::Vector3d plane_of(const Building& building, const BuildingFace& face) {
  constexpr double no_slope = 0.002;  // metres over the whole face
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(), middle = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& first = building.vertices[face.outline[0]];
  double low = 1e300, high = -1e300;
  for (std::size_t i = 0; i < face.outline.size(); ++i) {
    const Eigen::Vector3d& p = building.vertices[face.outline[i]];
    const Eigen::Vector3d& q = building.vertices[face.outline[(i + 1) % face.outline.size()]];
    normal += (p - first).cross(q - first);
    middle += p / static_cast<double>(face.outline.size());
    low = std::min(low, p.z());
    high = std::max(high, p.z());
  }
  if (!(normal.norm() > 0) || std::abs(normal.z()) < steep * normal.norm())
    return Eigen::Vector3d::Constant(std::nan(""));
  if (high - low < no_slope) return {0, 0, middle.z()};
  const double x = -normal.x() / normal.z(), y = -normal.y() / normal.z();
  return {x, y, middle.z() - x * middle.x() - y * middle.y()};
}

bool lies_on(const Building& building, const BuildingFace& face, const Plate& plate) {
  return std::all_of(face.outline.begin(), face.outline.end(), [&](std::uint32_t v) {
    const Eigen::Vector3d& p = building.vertices[v];
    return std::abs(plate.at(p.head<2>()) - p.z()) < one_plane;
  });
}

std::vector<Plate> plates_of(const Building& building) {
  std::vector<Plate> plates;
  for (std::size_t f = 0; f < building.faces.size(); ++f) {
    const BuildingFace& face = building.faces[f];
    if (face.surface != SurfaceClass::floor && face.surface != SurfaceClass::ceiling) continue;
    const Eigen::Vector3d plane = plane_of(building, face);
    if (!plane.allFinite()) continue;
    auto plate = std::find_if(plates.begin(), plates.end(), [&](const Plate& p) {
      return p.surface == face.surface && p.storey == face.storey && p.level() == (plane.x() == 0 && plane.y() == 0) &&
             lies_on(building, face, p);
    });
    if (plate == plates.end()) plate = plates.insert(plates.end(), Plate{face.surface, face.storey, {}, plane, {}, {}});
    plate->faces.push_back(static_cast<std::int32_t>(f));
    PlanRing outline;
    std::vector<PlanRing> holes;
    for (const auto v : face.outline) outline.emplace_back(building.vertices[v].head<2>());
    for (const auto& hole : face.holes) {
      holes.emplace_back();
      for (const auto v : hole) holes.back().emplace_back(building.vertices[v].head<2>());
    }
    const Region own = floorplan::minus(floorplan::united({outline}), floorplan::united(holes));
    plate->region.insert(plate->region.end(), own.begin(), own.end());
    plate->parts.push_back(floorplan::grown(own, slab_reach));
  }
  for (auto& plate : plates) plate.region = floorplan::joined(plate.region, {});
  return plates;
}

/// What a wall or a column rests on, and ends at: a polygon seen from above with the heights of its corners.
struct Footing {
  PlanPolygon polygon;
  std::vector<double> low, high;
};

std::vector<Footing> footings_of(const Elements& elements) {
  std::vector<Footing> result;
  for (const auto& wall : elements.walls)
    for (const auto& part : wall.profile)
      for (const auto& polygon : footprint_part(wall, part)) {
        Footing footing{polygon, {}, {}};
        for (const auto& p : polygon.outline) {
          const double share = std::clamp((wall.local(p).x() - part.from) / (part.to - part.from), 0.0, 1.0);
          footing.low.push_back(part.low_from + share * (part.low_to - part.low_from));
          footing.high.push_back(part.high_from + share * (part.high_to - part.high_from));
        }
        result.push_back(std::move(footing));
      }
  for (const auto& column : elements.columns)
    result.push_back({{column.outline, {}},
                      std::vector<double>(column.outline.size(), column.low),
                      std::vector<double>(column.outline.size(), column.high)});
  return result;
}

bool ends_at(const Footing& footing, const Plate& plate) {
  const auto& heights = plate.surface == SurfaceClass::floor ? footing.low : footing.high;
  for (std::size_t i = 0; i < heights.size(); ++i)
    if (std::abs(plate.at(footing.polygon.outline[i]) - heights[i]) > on_slab) return false;
  return true;
}

/// Adds the walls and columns that touch a plate and end at it; each belongs to the first plate of its class.
void add_footings(std::vector<Plate>& plates, const std::vector<Footing>& footings) {
  std::vector<bool> under(footings.size(), false), over(footings.size(), false);
  std::vector<Box> boxes;
  boxes.reserve(footings.size());
  for (const auto& footing : footings) boxes.emplace_back(footing.polygon.outline);
  for (auto& plate : plates) {
    std::vector<bool>& done = plate.surface == SurfaceClass::floor ? under : over;
    Region added = plate.region;
    for (const auto& part : plate.parts) {
      PlanRing corners;
      for (const auto& polygon : part) corners.insert(corners.end(), polygon.outline.begin(), polygon.outline.end());
      const Box box(corners);
      for (std::size_t i = 0; i < footings.size(); ++i) {
        if (done[i] || !box.meets(boxes[i]) || !ends_at(footings[i], plate)) continue;
        if (floorplan::common(part, {footings[i].polygon}).empty()) continue;
        done[i] = true;
        added.push_back(footings[i].polygon);
      }
    }
    plate.region = floorplan::joined(added, {});
  }
}

/// Without hairlines and crumbs.
Region tidy(const Region& region) {
  Region result;
  for (const auto& polygon : region)
    if (polygon.area() >= least_slab && !floorplan::grown({polygon}, -slab_reach).empty()) result.push_back(polygon);
  return result;
}

class SlabMaker {
 public:
  SlabMaker(const Building& building, const ElementLimits& limits, const std::vector<RoomSpace>& rooms,
            Elements& elements)
      : building_(building), limits_(limits), rooms_(rooms), elements_(elements), plates_(plates_of(building)) {
    add_footings(plates_, footings_of(elements));
  }

  void run() {
    pair_up();
    for (const auto& plate : plates_) add_single(plate);
    add_openings();
  }

 private:
  struct Pair {
    double common;
    std::size_t floor, ceiling;
    double thickness;
  };

  std::vector<Pair> pairs() const {
    std::vector<Pair> result;
    for (std::size_t f = 0; f < plates_.size(); ++f)
      for (std::size_t c = 0; c < plates_.size(); ++c) {
        if (plates_[f].surface != SurfaceClass::floor || plates_[c].surface != SurfaceClass::ceiling) continue;
        if (!plates_[f].level() || !plates_[c].level()) continue;
        const double thickness = plates_[f].plane.z() - plates_[c].plane.z();
        if (thickness < least_thickness || thickness > limits_.max_slab) continue;
        const double common = floorplan::area(floorplan::common(plates_[f].region, plates_[c].region));
        if (common >= least_common) result.push_back({common, f, c, thickness});
      }
    std::sort(result.begin(), result.end(), [](const Pair& a, const Pair& b) {
      return std::tuple(-a.common, a.floor, a.ceiling) < std::tuple(-b.common, b.floor, b.ceiling);
    });
    return result;
  }

  /// A floor over a ceiling: the greatest common areas first; what is left of both goes to their greatest partner.
  void pair_up() {
    const std::vector<Pair> all = pairs();
    std::vector<Region> bodies(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      Plate &floor = plates_[all[i].floor], &ceiling = plates_[all[i].ceiling];
      bodies[i] = floorplan::common(floor.region, ceiling.region);
      floor.region = floorplan::minus(floor.region, bodies[i]);
      ceiling.region = floorplan::minus(ceiling.region, bodies[i]);
    }
    for (std::size_t i = 0; i < all.size(); ++i)
      for (const std::size_t plate : {all[i].floor, all[i].ceiling}) {
        bodies[i] = floorplan::joined(bodies[i], plates_[plate].region);
        plates_[plate].region.clear();
      }
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Plate &floor = plates_[all[i].floor], &ceiling = plates_[all[i].ceiling];
      Slab slab;
      slab.kind = SlabKind::between;
      slab.storey = floor.storey;
      slab.faces = floor.faces;
      slab.faces.insert(slab.faces.end(), ceiling.faces.begin(), ceiling.faces.end());
      slab.bottom = ceiling.plane;
      slab.thickness = all[i].thickness;
      add(slab, bodies[i]);
    }
  }

  void add_single(const Plate& plate) {
    Slab slab;
    slab.kind = !plate.level()                         ? SlabKind::roof
                : plate.surface == SurfaceClass::floor ? SlabKind::floor
                                                       : SlabKind::ceiling;
    slab.storey = plate.storey;
    slab.faces = plate.faces;
    slab.assumed = true;
    slab.bottom = plate.plane;
    slab.thickness = limits_.assumed_slab * std::hypot(1, plate.plane.x(), plate.plane.y());
    if (plate.surface == SurfaceClass::floor) slab.bottom.z() -= slab.thickness;
    add(slab, plate.region);
  }

  /// Whether what lies between two heights everywhere over the polygon is in the slab for more than a hair.
  bool within(const Slab& slab, const PlanPolygon& polygon, double low, double high) const {
    double bottom = 1e300, top = -1e300;
    for (const auto& p : polygon.outline) {
      bottom = std::min(bottom, slab.bottom_at(p));
      top = std::max(top, slab.bottom_at(p) + slab.thickness);
    }
    return std::min(high, top) - std::max(low, bottom) > on_slab;
  }

  void add(Slab slab, const Region& region) {
    Region taken;
    if (slab.level()) {
      for (const auto& room : rooms_) {
        const Region own = occupied(room, slab.bottom.z(), slab.bottom.z() + slab.thickness, on_slab);
        taken.insert(taken.end(), own.begin(), own.end());
      }
      for (const auto& wall : elements_.walls)
        if (within(slab, wall.footprint, wall.low(), wall.high())) taken.push_back(wall.footprint);
      for (const auto& other : elements_.slabs)
        if (other.level() && within(slab, other.footprint, other.bottom.z(), other.bottom.z() + other.thickness))
          taken.push_back(other.footprint);
    }
    Region left = tidy(floorplan::minus(region, floorplan::joined(taken, {})));
    slab.whole = left.size() == 1 && taken.empty() && slab.kind != SlabKind::between;
    for (auto& polygon : left) {
      slab.footprint = std::move(polygon);
      Slab own = slab;
      if (!slab.whole) own.faces = faces_on(slab);
      for (const auto f : own.faces)
        if (auto& of = elements_.slab_of_face[static_cast<std::size_t>(f)]; of < 0)
          of = static_cast<std::int32_t>(elements_.slabs.size());
      elements_.slabs.push_back(std::move(own));
    }
  }

  /// Those of the slab's faces that have at least a tenth of their area at this part of it.
  std::vector<std::int32_t> faces_on(const Slab& slab) const {
    std::vector<std::int32_t> result;
    for (const auto f : slab.faces) {
      PlanRing outline;
      for (const auto v : building_.faces[static_cast<std::size_t>(f)].outline)
        outline.emplace_back(building_.vertices[v].head<2>());
      if (!Box(outline).meets(Box(slab.footprint.outline))) continue;
      const Region own = floorplan::united({outline});
      if (floorplan::area(floorplan::common(own, {slab.footprint})) > 0.1 * floorplan::area(own)) result.push_back(f);
    }
    return result;
  }

  void add_openings() {
    for (std::size_t o = 0; o < building_.openings.size(); ++o) {
      const BuildingOpening& opening = building_.openings[o];
      if (opening.outline_a.size() < 3 || !in_slab(building_, opening)) continue;
      PlanRing ring;
      for (const auto& p : opening.outline_a) ring.emplace_back(p.head<2>());
      const Region hole = floorplan::united({ring});
      double most = least_slab;
      Slab* best = nullptr;
      for (auto& slab : elements_.slabs) {
        const bool its = std::any_of(slab.faces.begin(), slab.faces.end(),
                                     [&](std::int32_t f) { return f == opening.face_a || f == opening.face_b; });
        if (!its) continue;
        const double common = floorplan::area(floorplan::common(hole, {slab.footprint}));
        if (common <= most) continue;
        most = common;
        best = &slab;
      }
      if (best != nullptr) best->openings.push_back(static_cast<std::int32_t>(o));
    }
  }

  const Building& building_;
  const ElementLimits& limits_;
  const std::vector<RoomSpace>& rooms_;
  Elements& elements_;
  std::vector<Plate> plates_;
};

}  // namespace

void add_slabs(const Building& building, const ElementLimits& limits, const std::vector<RoomSpace>& rooms,
               Elements& elements) {
  SlabMaker(building, limits, rooms, elements).run();
}

}  // namespace atrium::building
