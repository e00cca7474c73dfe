#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "graph/api/text.hpp"
#include "modules/building/corrections.hpp"
#include "modules/building/room_measures.hpp"

namespace atrium::building {
namespace {

constexpr double parallel_cosine = 0.996;  // 5 degrees
constexpr double one_wall = 0.02;          // metres

/// Takes a wall's face away: its neighbours are extended until they meet.
class FaceDrop {
 public:
  FaceDrop(CorrectionDraft& draft, const Correction& correction, std::int32_t face)
      : draft_(draft), correction_(correction), face_(face), room_(draft.face(face).room) {
    for (const auto f : draft.room(room_).faces) {
      const auto add = [&](const std::vector<std::uint32_t>& ring) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
          sides_[{ring[i], ring[(i + 1) % ring.size()]}] = f;
          around_[ring[i]].insert(f);
        }
      };
      add(draft.face(f).outline);
      for (const auto& hole : draft.face(f).holes) add(hole);
    }
  }

  RoomShell run() {
    if (is_column()) return without_column();
    const std::vector<std::int32_t> beside = walls_beside(face_);
    if (beside.size() != 2) ambiguous(counted(beside.size(), "wall stands", "walls stand") + " beside it");
    refuse_openings({face_});
    const Eigen::Vector3d &first = plane(beside[0]).normal, &second = plane(beside[1]).normal;
    if (std::abs(first.dot(second)) < parallel_cosine) return moved({plane(beside[0]), plane(beside[1])});
    return moved({plane(wall_beyond(beside))});
  }

 private:
  const Plane& plane(std::int32_t face) const { return draft_.face(face).plane; }

  [[noreturn]] void ambiguous(const std::string& why) const {
    correction_.fail({}, fmt::format("it is not clear what comes in the place of {}: {}", draft_.face_name(face_), why),
                     "move_wall moves a face to where another one is");
  }

  void refuse_openings(const std::vector<std::int32_t>& faces) const {
    for (std::size_t o = 0; o < draft_.building.openings.size(); ++o)
      for (const auto f : faces)
        if (draft_.building.openings[o].face_a == f || draft_.building.openings[o].face_b == f)
          correction_.fail(
              {}, fmt::format("{} is in {}", draft_.opening_name(static_cast<std::int32_t>(o)), draft_.face_name(f)),
              "drop it first, with drop_opening");
  }

  /// The walls across the face's upright sides.
  std::vector<std::int32_t> walls_beside(std::int32_t face) const {
    constexpr double upright = 0.7;
    std::vector<std::int32_t> result;
    const auto& ring = draft_.face(face).outline;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::uint32_t a = ring[i], b = ring[(i + 1) % ring.size()];
      const Eigen::Vector3d side = (draft_.building.vertices[b] - draft_.building.vertices[a]).normalized();
      const auto other = sides_.find({b, a});
      if (std::abs(side.z()) < upright || other == sides_.end()) continue;
      if (draft_.face(other->second).surface != SurfaceClass::wall) continue;
      if (std::find(result.begin(), result.end(), other->second) == result.end()) result.push_back(other->second);
    }
    return result;
  }

  /// Between two parallel sides (of a pilaster or niche) the wall beyond them takes the face's place.
  std::int32_t wall_beyond(const std::vector<std::int32_t>& beside) const {
    std::vector<std::int32_t> found;
    for (const auto side : beside)
      for (const auto beyond : walls_beside(side)) {
        if (beyond == face_ || plane(beyond).normal.dot(plane(face_).normal) < parallel_cosine) continue;
        const bool known = std::any_of(found.begin(), found.end(), [&](std::int32_t f) {
          return std::abs(plane(f).signed_distance(draft_.building.vertices[draft_.face(beyond).outline[0]])) <
                 one_wall;
        });
        if (!known) found.push_back(beyond);
      }
    if (found.empty()) ambiguous("the walls beside it are parallel, and none beyond them looks the same way");
    if (found.size() > 1)
      ambiguous(fmt::format("{} and {} are not in one plane", draft_.face_name(found[0]), draft_.face_name(found[1])));
    return found.front();
  }

  /// The room with the face's corners in these planes and, but for its own, in those that they are in.
  RoomShell moved(const std::vector<Plane>& targets) const {
    std::map<std::uint32_t, Eigen::Vector3d> places;
    const auto move = [&](const std::vector<std::uint32_t>& ring) {
      for (const auto v : ring) {
        const Eigen::Vector3d& at = draft_.building.vertices[v];
        std::vector<PlaneShift> planes;
        planes.reserve(targets.size());
        for (const auto& target : targets) planes.push_back({target.normal, -target.signed_distance(at)});
        for (const auto f : around_.at(v)) {
          const bool is_target = std::any_of(targets.begin(), targets.end(), [&](const Plane& t) {
            return std::abs(t.normal.dot(plane(f).normal)) > parallel_cosine;
          });
          if (f != face_ && !is_target) planes.push_back({plane(f).normal, 0});
        }
        Eigen::Vector3d motion;
        if (!motion_of(planes, motion)) ambiguous("the walls beside it meet nowhere at " + draft_.told(at));
        places[v] = at + motion;
      }
    };
    move(draft_.face(face_).outline);
    for (const auto& hole : draft_.face(face_).holes) move(hole);
    std::vector<ShellPiece> pieces;
    for (const auto f : draft_.room(room_).faces) {
      ShellPiece piece = piece_of(draft_.building, f);
      const auto take = [&](const std::vector<std::uint32_t>& ring, std::vector<Eigen::Vector3d>& outline) {
        for (std::size_t i = 0; i < ring.size(); ++i)
          if (const auto found = places.find(ring[i]); found != places.end()) outline[i] = found->second;
      };
      take(draft_.face(f).outline, piece.outline);
      for (std::size_t h = 0; h < piece.holes.size(); ++h) take(draft_.face(f).holes[h], piece.holes[h]);
      if (f == face_ && targets.size() > 1) continue;
      if (f == face_) take_over(piece, targets.front());
      pieces.push_back(std::move(piece));
    }
    return joined_shell(pieces);
  }

  /// What comes in the place of the face was not seen there.
  static void take_over(ShellPiece& piece, const Plane& target) {
    piece.face.plane = target;
    piece.face.primitive = -1;
    piece.face.observed = piece.face.residual = 0;
    piece.face.backing = 0;
    piece.face.corrections.emplace_back("in another plane, by drop_face");
  }

  /// The ring of a floor's hole that the face stands on; null without one.
  const std::vector<std::uint32_t>* hole_below() const {
    for (const auto f : draft_.room(room_).faces) {
      if (draft_.face(f).surface != SurfaceClass::floor) continue;
      for (const auto& hole : draft_.face(f).holes)
        for (std::size_t i = 0; i < hole.size(); ++i) {
          const auto other = sides_.find({hole[(i + 1) % hole.size()], hole[i]});
          if (other != sides_.end() && other->second == face_) return &hole;
        }
    }
    return nullptr;
  }
  bool is_column() const { return hole_below() != nullptr; }

  /// All faces around a column, and the holes that it stands in.
  RoomShell without_column() const {
    std::set<std::int32_t> gone{face_};
    std::vector<std::int32_t> open{face_};
    while (!open.empty()) {
      const std::int32_t f = open.back();
      open.pop_back();
      for (const auto next : walls_beside(f))
        if (gone.insert(next).second) open.push_back(next);
    }
    refuse_openings({gone.begin(), gone.end()});
    std::set<std::uint32_t> corners;
    for (const auto f : gone) corners.insert(draft_.face(f).outline.begin(), draft_.face(f).outline.end());
    std::vector<ShellPiece> pieces;
    for (const auto f : draft_.room(room_).faces) {
      if (gone.count(f) != 0) continue;
      ShellPiece piece = piece_of(draft_.building, f);
      piece.holes.clear();
      const ShellPiece whole = piece_of(draft_.building, f);
      for (std::size_t h = 0; h < whole.holes.size(); ++h)
        if (corners.count(draft_.face(f).holes[h].front()) == 0) piece.holes.push_back(whole.holes[h]);
      pieces.push_back(std::move(piece));
    }
    return joined_shell(pieces);
  }

  CorrectionDraft& draft_;
  const Correction& correction_;
  std::int32_t face_, room_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::int32_t> sides_;
  std::map<std::uint32_t, std::set<std::int32_t>> around_;
};

}  // namespace

void drop_face(CorrectionDraft& draft, const Correction& correction) {
  const std::int32_t index = draft.room_of(correction), face = draft.face_of(correction, index);
  const std::string called = wall_called(draft, correction, face);
  const Overlap before = overlap_of(draft.building, {index});
  RoomShell shell = FaceDrop(draft, correction, face).run();
  if (!is_closed(shell.faces) || parts_of(shell.faces) != 1)
    correction.fail({}, fmt::format("without {} '{}' would not be closed", called, draft.room(index).name),
                    "its neighbours meet on the wrong side: move_wall moves a face to where another one is");
  const auto rooms = draft.replace(correction, {index}, {{draft.room(index), std::move(shell)}});
  settle_rooms(draft, correction, rooms, before);
  draft.mark(rooms[0], called + " dropped");
}

}  // namespace atrium::building
