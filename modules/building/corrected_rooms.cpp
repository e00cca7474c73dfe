#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "graph/api/error.hpp"
#include "modules/building/corrections.hpp"
#include "modules/building/room_measures.hpp"
#include "modules/geometry/plan_overlay.hpp"
#include "modules/geometry/plane_frame.hpp"
#include "modules/types/building_rules.hpp"

namespace atrium::building {
namespace {

/// Takes the wall between two rooms away.
class RoomMerging {
 public:
  RoomMerging(CorrectionDraft& draft, const Correction& correction, std::int32_t a, std::int32_t b)
      : draft_(draft), correction_(correction), a_(a), b_(b) {
    for (const auto r : {a, b})
      for (const auto f : draft.room(r).faces) {
        const BuildingFace& face = draft.face(f);
        left_[f] = {flat_polygon(draft.building, face)};
      }
  }

  RoomShell run() {
    struct Pair {
      std::int32_t front, back;
      double thickness;
    };
    std::vector<Pair> pairs;
    for (const auto f : draft_.room(a_).faces)
      for (const auto g : draft_.room(b_).faces)
        if (const double thickness = between(f, g); thickness >= 0) pairs.push_back({f, g, thickness});
    // What is nearest is in the way of what is behind it.
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& x, const Pair& y) { return x.thickness < y.thickness; });
    for (const auto& pair : pairs) open(pair.front, pair.back);
    if (tunnels_.empty() && !touching_)
      correction_.fail(
          "rooms", fmt::format("'{}' and '{}' share no wall", draft_.room(a_).name, draft_.room(b_).name),
          fmt::format("no two of their walls are back to back at most {:.2f} m apart", draft_.max_thickness));
    std::vector<ShellPiece> pieces = std::move(tunnels_);
    for (const auto& [f, polygons] : left_)
      for (const auto& polygon : polygons)
        pieces.push_back(part_of(piece_of(draft_.building, f), frame_of(draft_.building, draft_.face(f)), polygon));
    return joined_shell(pieces);
  }

 private:
  /// The wall's thickness; −1 if the faces are not back to back.
  double between(std::int32_t f, std::int32_t g) const {
    const BuildingFace &front = draft_.face(f), &back = draft_.face(g);
    const double opposite = -std::cos(wall_parallel_angle * EIGEN_PI / 180);
    if (front.surface != SurfaceClass::wall || back.surface != SurfaceClass::wall ||
        front.plane.normal.dot(back.plane.normal) > opposite)
      return -1;
    constexpr double overlapping = 0.001, crumb = 0.001;
    const auto shared = common(f, g);
    if (!(overlay::area(shared) > crumb)) return -1;
    const Eigen::Vector2d middle = overlay::centroid(shared);
    const double thickness = -back.plane.signed_distance(frame_of(draft_.building, front).to_space(middle));
    return thickness < -overlapping || thickness > draft_.max_thickness ? -1 : std::max(thickness, 0.0);
  }

  /// What is left of both, in the first one's frame.
  std::vector<PlanPolygon> common(std::int32_t f, std::int32_t g) const {
    const PlaneFrame frame = frame_of(draft_.building, draft_.face(f)),
                     other = frame_of(draft_.building, draft_.face(g));
    std::vector<PlanPolygon> result;
    for (const auto& polygon : left_.at(g)) {
      const auto shared = overlay::intersection(left_.at(f), seen_from(frame, other, polygon));
      result.insert(result.end(), shared.begin(), shared.end());
    }
    return result;
  }
  static PlanPolygon seen_from(const PlaneFrame& frame, const PlaneFrame& other, const PlanPolygon& polygon) {
    const auto turned = [&](const PlanRing& ring) {
      PlanRing result;
      for (const auto& p : ring) result.push_back(frame.to_plane(other.to_space(p)));
      return result;
    };
    PlanPolygon result{turned(polygon.outline), {}};
    for (const auto& hole : polygon.holes) result.holes.push_back(turned(hole));
    return overlay::corrected(result);
  }

  void open(std::int32_t f, std::int32_t g) {
    constexpr double crumb = 0.001;  // square metres
    const PlaneFrame frame = frame_of(draft_.building, draft_.face(f)),
                     other = frame_of(draft_.building, draft_.face(g));
    for (const auto& hole : common(f, g)) {
      if (overlay::area(hole) < crumb) continue;
      touching_ = true;
      take_openings(f, frame, hole);
      take_openings(g, frame, hole);
      PlanPolygon behind;
      const auto through = [&](const PlanRing& ring) {
        PlanRing result;
        const Plane& back = draft_.face(g).plane;
        for (std::size_t i = 0; i < ring.size(); ++i) {
          const Eigen::Vector3d p = frame.to_space(ring[i]), q = frame.to_space(ring[(i + 1) % ring.size()]);
          const auto beyond = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d {
            const Eigen::Vector3d& n = draft_.face(f).plane.normal;
            return x - n * (back.signed_distance(x) / back.normal.dot(n));
          };
          result.push_back(other.to_plane(beyond(p)));
          const Eigen::Vector3d normal = (q - p).cross(beyond(p) - p);
          constexpr double flat = 1e-9;
          if (normal.norm() > flat) tunnels_.push_back(new_piece({p, q, beyond(q), beyond(p)}, normal.normalized()));
        }
        return result;
      };
      behind.outline = through(hole.outline);
      for (const auto& ring : hole.holes) behind.holes.push_back(through(ring));
      left_[f] = overlay::difference(left_[f], hole);
      left_[g] = overlay::difference(left_[g], overlay::corrected(behind));
    }
  }

  /// Openings in what goes go with it.
  void take_openings(std::int32_t face, const PlaneFrame& frame, const PlanPolygon& hole) {
    constexpr double most = 0.99, crumb = 0.01;
    for (std::size_t o = draft_.building.openings.size(); o-- > 0;) {
      const BuildingOpening& opening = draft_.building.openings[o];
      const auto& outline = opening.face_a == face ? opening.outline_a : opening.outline_b;
      if ((opening.face_a != face && opening.face_b != face) || outline.size() < 3) continue;
      PlanPolygon polygon;
      for (const auto& p : outline) polygon.outline.push_back(frame.to_plane(p));
      polygon = overlay::corrected(polygon);
      const double share = overlay::area(overlay::intersection({polygon}, hole)) / overlay::area(polygon);
      const auto index = static_cast<std::int32_t>(o);
      if (share > most)
        draft_.drop_opening(index);
      else if (share > crumb)
        correction_.fail("rooms",
                         fmt::format("{} lies in the wall that goes with {:.0f} % of it only",
                                     draft_.opening_name(index), 100 * share),
                         "drop or change it first, with drop_opening or change_opening");
    }
  }

  CorrectionDraft& draft_;
  const Correction& correction_;
  std::int32_t a_, b_;
  std::map<std::int32_t, std::vector<PlanPolygon>> left_;  ///< per face of both rooms, in its own frame
  std::vector<ShellPiece> tunnels_;
  bool touching_ = false;
};

/// Floors (or ceilings) of b that lie at the height of a's main one but for 2 cm take that height, where they can: a
/// merged room has no steps that nobody has seen.
void align_levels(CorrectionDraft& draft, const Correction& correction, std::int32_t a, std::int32_t b,
                  SurfaceClass surface) {
  constexpr double level = 0.9999, near = 0.02, same = 1e-6;
  const auto z = [&](std::int32_t f) { return draft.building.vertices[draft.face(f).outline[0]].z(); };
  const auto is_level = [&](std::int32_t f) {
    return draft.face(f).surface == surface && std::abs(draft.face(f).plane.normal.z()) > level;
  };
  double height = 0, most = 0;
  for (const auto f : draft.room(a).faces) {
    const double area = flat_polygon(draft.building, draft.face(f)).area();
    if (!is_level(f) || area <= most) continue;
    most = area;
    height = z(f);
  }
  std::map<std::int32_t, double> shifts;
  for (const auto f : draft.room(b).faces)
    if (most > 0 && is_level(f) && std::abs(height - z(f)) < near && std::abs(height - z(f)) > same)
      shifts[f] = (height - z(f)) * draft.face(f).plane.normal.z();
  if (shifts.empty()) return;
  CorrectionDraft tried = draft;
  try {
    shift_faces(tried, correction, shifts);
  } catch (const Error&) {
    return;  // the step stays
  }
  draft = std::move(tried);
}

}  // namespace

void rename_room(CorrectionDraft& draft, const Correction& correction) {
  const std::int32_t room = draft.room_of(correction);
  const std::string& name = correction.text("name");
  for (std::size_t r = 0; r < draft.building.rooms.size(); ++r)
    if (static_cast<std::int32_t>(r) != room && draft.building.rooms[r].name == name)
      correction.fail("name", fmt::format("there is a room '{}' already", name), "rooms have different names");
  draft.rename(room, name);
}

void merge_rooms(CorrectionDraft& draft, const Correction& correction) {
  const auto both = draft.rooms_of(correction);
  const std::int32_t a = both[0], b = both[1];
  if (a == b) correction.fail("rooms", fmt::format("both are '{}'", draft.room(a).name), "two rooms become one");
  if (draft.room(a).storey != draft.room(b).storey)
    correction.fail("rooms",
                    fmt::format("'{}' and '{}' are on different storeys", draft.room(a).name, draft.room(b).name),
                    "rooms of one storey");
  const Overlap before = overlap_of(draft.building, {a, b});
  align_levels(draft, correction, a, b, SurfaceClass::floor);
  align_levels(draft, correction, a, b, SurfaceClass::ceiling);
  BuildingRoom room = draft.room(a);
  const BuildingRoom& other = draft.room(b);
  const std::string first = room.name, second = other.name;
  if (room.confidence >= 0 && other.confidence >= 0)
    room.confidence = (room.area * room.confidence + other.area * other.confidence) / (room.area + other.area);
  for (const auto& doubt : other.doubts)
    if (std::find(room.doubts.begin(), room.doubts.end(), doubt) == room.doubts.end()) room.doubts.push_back(doubt);
  if (correction.has("name")) room.name = correction.text("name");
  RoomShell shell = RoomMerging(draft, correction, a, b).run();
  if (!is_closed(shell.faces) || parts_of(shell.faces) != 1)
    correction.fail("rooms", fmt::format("'{}' and '{}' do not become one closed room", first, second),
                    "their walls meet in a way that leaves it open which space is between them");
  const auto rooms = draft.replace(correction, {a, b}, {{std::move(room), std::move(shell)}});
  settle_rooms(draft, correction, rooms, before);
  draft.mark(rooms[0], fmt::format("merged from {} and {}", first, second));
}

}  // namespace atrium::building
