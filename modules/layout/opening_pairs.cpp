#include "modules/layout/opening_pairs.hpp"

#include <algorithm>
#include <cmath>

#include "modules/layout/wall_pairs.hpp"

namespace atrium::layout {
namespace {

Eigen::Vector3d moved_onto(const Plane& plane, const Eigen::Vector3d& p) {
  return p - plane.normal * plane.signed_distance(p);
}

using Squares = std::vector<std::vector<Eigen::Vector2i>>;  // per face

/// The squares of each face that are `mine`, and of which a face behind it says `its`.
Squares squares_where(const Building& building, const Evidence& evidence, Square mine, Square its) {
  const auto behind = opposite_faces(building);
  Squares result(evidence.size());
  for (std::size_t f = 0; f < evidence.size(); ++f) {
    const FaceMask& mask = evidence[f].mask;
    for (int y = 0; y < mask.height(); ++y)
      for (int x = 0; x < mask.width(); ++x) {
        if (mask.at(x, y) != mine) continue;
        const Eigen::Vector3d p = evidence[f].frame.to_space(mask.centre(x, y));
        if (std::any_of(behind[f].begin(), behind[f].end(), [&](std::size_t other) {
              return evidence[other].looked_at() && evidence[other].mask.at(evidence[other].frame.to_plane(p)) == its;
            }))
          result[f].emplace_back(x, y);
      }
  }
  return result;
}

/// The second rectangle in the frame of the first.
Eigen::AlignedBox2d box_in(const FaceHole& frame, const FaceHole& hole) {
  Eigen::AlignedBox2d box;
  for (const auto& p : outline_of(hole)) box.extend(frame.frame.to_plane(p));
  return box;
}

/// Intersection over the smaller of two rectangles.
double shared(const FaceHole& a, const FaceHole& b) {
  const Eigen::AlignedBox2d box = box_in(a, b), both = a.box.intersection(box);
  return both.isEmpty() ? 0 : both.volume() / std::min(a.box.volume(), box.volume());
}

/// Each side where more points say so.
void agree(FaceHole& a, const FaceHole& b) {
  const Eigen::AlignedBox2d box = box_in(a, b);
  const bool turned = a.frame.u.dot(b.frame.u) < 0;  // the other's left is this one's right
  for (std::size_t s = 0; s < 4; ++s) {
    const std::size_t its = s < 2 && turned ? 1 - s : s;
    if (b.support[its] <= a.support[s]) continue;
    const auto axis = static_cast<Eigen::Index>(s / 2);
    (s % 2 == 0 ? a.box.min()[axis] : a.box.max()[axis]) = s % 2 == 0 ? box.min()[axis] : box.max()[axis];
  }
}

/// What is known to lead on and hides its foot is a door.
void reach_foot(FaceHole& hole) {
  hole.kind = "door";
  hole.box.min().y() = hole.foot;
}

/// Whether a hole down to the floor is too large for a door of one leaf: it is glazed down to the floor.
bool is_glass(const Eigen::Vector2d& size) {
  constexpr double widest = 1.3, lowest = 1.8, highest = 2.4;  // metres
  return size.y() > highest || (size.y() >= lowest && size.x() > widest);
}

/// Whether it may be a gate or a door of two leaves all the same, where no other door leads into its room.
bool is_gate(const Eigen::Vector2d& size) {
  constexpr double widest = 2.1, highest = 2.5;  // metres
  return size.x() <= widest && size.y() <= highest;
}

bool has_top_of_door(const FaceHole& hole) {
  constexpr double widest = 1.3, lowest = 1.9, highest = 2.3;  // metres
  const double top = hole.box.max().y() - hole.foot;
  return hole.box.sizes().x() <= widest && top >= lowest && top <= highest;
}

/// Whether a window of which the wall below is hidden may be the only door of its room.
bool may_be_only_door(const FaceHole& hole) {
  constexpr double widest = 1.1, most_hidden = 1;  // metres
  return has_top_of_door(hole) && hole.box.sizes().x() <= widest && hole.box.min().y() - hole.foot <= most_hidden;
}

/// A hole that is a window, and may be a door.
struct MaybeDoor {
  std::size_t opening = 0, face = 0;
  FaceHole hole;
  bool foot_hidden = false;  ///< otherwise it reaches the floor, and is glazed by its size
};

class Joining {
 public:
  Joining(const Building& building, const Found& found, const Openings::Params& params)
      : building_(building), found_(found), params_(params), behind_(opposite_faces(building)) {
    for (const auto& holes : found) used_.emplace_back(holes.size(), false);
  }

  JoinedOpenings run() {
    for (std::size_t f = 0; f < found_.size(); ++f)
      for (std::size_t h = 0; h < found_[f].size(); ++h)
        if (!used_[f][h]) join(f, found_[f][h], used_[f].begin() + static_cast<std::ptrdiff_t>(h));
    open_closed_rooms();
    return std::move(joined_);
  }

 private:
  void join(std::size_t f, FaceHole hole, std::vector<bool>::iterator used) {
    constexpr double enough = 0.5;
    *used = true;
    std::size_t other = 0, twin = 0;
    double most = enough;
    for (const auto face : behind_[f])
      for (std::size_t k = 0; k < found_[face].size(); ++k) {
        if (used_[face][k]) continue;
        const double share = shared(hole, found_[face][k]);
        if (share <= most) continue;
        most = share;
        other = face;
        twin = k;
      }
    if (most > enough) {
      used_[other][twin] = true;
      const FaceHole& back = found_[other][twin];
      const bool door = hole.kind == "door" || back.kind == "door" || (hole.foot_hidden && back.foot_hidden);
      agree(hole, back);
      if (door) reach_foot(hole);
      add(f, hole, &other);
      return;
    }
    // The face behind, where it stands over the whole hole, was not seen there.
    for (const auto face : behind_[f]) {
      const auto outline = outline_of(hole);
      if (!std::all_of(outline.begin(), outline.end(), [&](const Eigen::Vector3d& p) {
            const BuildingFace& back = building_.faces[face];
            return face_contains(building_, back, moved_onto(back.plane, p), 0.02);
          }))
        continue;
      other = face;
      if (hole.foot_hidden) reach_foot(hole);
      add(f, hole, &other);
      return;
    }
    lead_out(f, std::move(hole));
  }

  /// A hole with nothing on the other side.
  void lead_out(std::size_t f, FaceHole hole) {
    if (hole.kind == "window" && hole.foot_hidden) {
      // The pane of a window is behind its wall as leaves are.
      if (hole.leads_on && has_top_of_door(hole)) {
        reach_foot(hole);
      } else if (hole.leads_on || has_top_of_door(hole)) {
        ++joined_.hidden_feet;
        if (may_be_only_door(hole)) maybe_.push_back({joined_.openings.size(), f, hole, true});
      }
    }
    if (!hole.leads_on && hole.kind == "door") {
      if (is_glass(hole.box.sizes())) {
        hole.kind = "window";
        ++joined_.blank_windows;
        if (is_gate(hole.box.sizes())) maybe_.push_back({joined_.openings.size(), f, hole, false});
      } else if (hole.box.sizes().y() < params_.min_door_height) {
        ++joined_.low_blanks;
        return;
      } else {
        ++joined_.blank_doors;
      }
    }
    add(f, hole, nullptr);
  }

  /// A room into which nothing leads has its entrance where there may be a door: the narrowest of the holes down to the
  /// floor, or else of those whose foot is hidden.
  void open_closed_rooms() {
    std::vector<bool> open(building_.rooms.size(), false);
    for (const auto& opening : joined_.openings)
      for (const auto room : {opening.room_a, opening.room_b})
        if (room >= 0 && opening.kind != "window") open[static_cast<std::size_t>(room)] = true;
    std::stable_sort(maybe_.begin(), maybe_.end(), [](const MaybeDoor& a, const MaybeDoor& b) {
      return a.foot_hidden != b.foot_hidden ? b.foot_hidden : a.hole.box.sizes().x() < b.hole.box.sizes().x();
    });
    for (auto& maybe : maybe_) {
      const auto room = static_cast<std::size_t>(building_.faces[maybe.face].room);
      if (open[room]) continue;
      open[room] = true;
      reach_foot(maybe.hole);
      joined_.openings[maybe.opening] = opening_of(maybe.face, maybe.hole, nullptr);
      --(maybe.foot_hidden ? joined_.hidden_feet : joined_.blank_windows);
      ++(maybe.foot_hidden ? joined_.only_doors : joined_.blank_doors);
    }
  }

  void add(std::size_t f, const FaceHole& hole, const std::size_t* other) {
    joined_.openings.push_back(opening_of(f, hole, other));
  }

  BuildingOpening opening_of(std::size_t f, const FaceHole& hole, const std::size_t* other) const {
    BuildingOpening opening;
    const bool passage = hole.kind == "door" && hole.box.sizes().x() > params_.max_door_width;
    opening.kind = passage ? "passage" : hole.kind;
    opening.face_a = static_cast<std::int32_t>(f);
    opening.room_a = building_.faces[f].room;
    opening.outline_a = outline_of(hole);
    if (other != nullptr) {
      const BuildingFace& back = building_.faces[*other];
      opening.face_b = static_cast<std::int32_t>(*other);
      opening.room_b = back.room;
      opening.thickness = std::abs(back.plane.signed_distance(opening.outline_a[0]));
      for (auto it = opening.outline_a.rbegin(); it != opening.outline_a.rend(); ++it)
        opening.outline_b.push_back(moved_onto(back.plane, *it));
    }
    return opening;
  }

  const Building& building_;
  const Found& found_;
  const Openings::Params& params_;
  std::vector<std::vector<std::size_t>> behind_;
  std::vector<std::vector<bool>> used_;
  std::vector<MaybeDoor> maybe_;
  JoinedOpenings joined_;
};

}  // namespace

std::vector<std::vector<std::size_t>> opposite_faces(const Building& building) {
  std::vector<std::vector<std::size_t>> result(building.faces.size());
  for (const auto& wall : building.walls) {
    const auto a = static_cast<std::size_t>(wall.face_a), b = static_cast<std::size_t>(wall.face_b);
    result[a].push_back(b);
    result[b].push_back(a);
  }
  return result;
}

void take_solid_from_behind(const Building& building, Evidence& evidence) {
  const Squares taken = squares_where(building, evidence, Square::hidden, Square::solid);
  for (std::size_t f = 0; f < evidence.size(); ++f)
    for (const auto& square : taken[f]) evidence[f].mask.at(square.x(), square.y()) = Square::solid;
}

void take_holes_from_behind(const Building& building, Evidence& evidence) {
  const Squares both = squares_where(building, evidence, Square::hole, Square::hole);
  const Squares taken = squares_where(building, evidence, Square::hidden, Square::hole);
  for (std::size_t f = 0; f < evidence.size(); ++f) {
    if (!evidence[f].looked_at()) continue;
    evidence[f].seen_from_both = FaceMask(evidence[f].mask.box(), evidence[f].mask.pixel());
    // With known ways of sight those through the hole must be there.
    if (!evidence[f].ways_known)
      for (const auto& square : both[f]) evidence[f].seen_from_both.at(square.x(), square.y()) = Square::hole;
    for (const auto& square : taken[f]) evidence[f].mask.at(square.x(), square.y()) = Square::hole;
  }
}

JoinedOpenings joined(const Building& building, const Found& found, const Openings::Params& params) {
  return Joining(building, found, params).run();
}

}  // namespace atrium::layout
