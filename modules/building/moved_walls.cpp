#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "modules/building/corrections.hpp"
#include "modules/building/room_measures.hpp"
#include "modules/layout/wall_pairs.hpp"

namespace atrium::building {
namespace {

/// The walls' faces that are back to back with this one, and those with these.
std::set<std::int32_t> whole_wall(const CorrectionDraft& draft, std::int32_t face) {
  const auto pairs = layout::wall_pairs(draft.building, draft.max_thickness);
  std::set<std::int32_t> wall{face};
  for (std::size_t before = 0; before < wall.size();) {
    before = wall.size();
    for (const auto& pair : pairs) {
      if (draft.building.faces[static_cast<std::size_t>(pair.face_a)].surface != SurfaceClass::wall) continue;
      if (wall.count(pair.face_a) != 0 || wall.count(pair.face_b) != 0) wall.insert({pair.face_a, pair.face_b});
    }
  }
  return wall;
}

/// The room's floors or ceilings that are meant: by `face`, else all.
std::vector<std::int32_t> levels_meant(CorrectionDraft& draft, const Correction& correction, std::int32_t room,
                                       SurfaceClass surface) {
  if (correction.has("face")) {
    const std::int32_t face = draft.numbered_face(correction, room);
    if (draft.face(face).surface != surface)
      correction.fail("face", fmt::format("{} is a {}", draft.face_name(face), name_of(draft.face(face).surface)),
                      fmt::format("give one of its {}s", name_of(surface)));
    return {face};
  }
  std::vector<std::int32_t> faces;
  for (const auto f : draft.room(room).faces)
    if (draft.face(f).surface == surface) faces.push_back(f);
  if (faces.empty()) correction.fail("room", fmt::format("'{}' has no {}", draft.room(room).name, name_of(surface)));
  return faces;
}

/// Their one height, in the building's coordinates.
double height_of(const CorrectionDraft& draft, const Correction& correction, const std::vector<std::int32_t>& faces,
                 std::string_view key) {
  constexpr double level = 0.9999, one_height = 0.002;
  const auto z = [&](std::int32_t f) {
    const BuildingFace& face = draft.building.faces[static_cast<std::size_t>(f)];
    return draft.building.vertices[face.outline[0]].z();
  };
  std::string names;
  bool one = true;
  for (const auto f : faces) {
    names += fmt::format("{}{}", names.empty() ? "" : ", ", draft.face_name(f));
    one = one && std::abs(z(f) - z(faces.front())) < one_height;
    if (std::abs(draft.building.faces[static_cast<std::size_t>(f)].plane.normal.z()) < level)
      correction.fail(key, fmt::format("{} slopes: it has no height", draft.face_name(f)),
                      "give `by`, or another one's number as `face`");
  }
  if (!one)
    correction.fail(key, fmt::format("there are several heights ({})", names),
                    "say with `face` which is meant, or give `by`");
  return z(faces.front());
}

void raise(CorrectionDraft& draft, const Correction& correction, std::int32_t room,
           const std::vector<std::int32_t>& faces, double by) {
  std::map<std::int32_t, double> shifts;
  for (const auto f : faces) shifts[f] = by * draft.face(f).plane.normal.z();
  const Overlap before = overlap_of(draft.building, {room});
  shift_faces(draft, correction, shifts);
  settle_rooms(draft, correction, {room}, before);
}

/// Where the thickness of a wall was given by hand, its far side stays when the near one moves.
void keep_far_sides(CorrectionDraft& draft, const Correction& correction, const std::vector<BuildingFace>& before) {
  constexpr double thinnest = 0.01;  // metres
  for (std::size_t f = 0; f < before.size(); ++f) {
    BuildingFace& face = draft.building.faces[f];
    if (!(face.backing > 0)) continue;
    const double thickness = before[f].backing + before[f].plane.offset - face.plane.offset;
    if (thickness < thinnest)
      correction.fail("by",
                      fmt::format("that is too far: {} is {:.3f} m thick there, by set_thickness",
                                  draft.face_name(static_cast<std::int32_t>(f)), before[f].backing),
                      "a smaller value; or `both: true`, which moves the whole wall");
    face.backing = thickness;
  }
}

}  // namespace

std::string wall_called(const CorrectionDraft& draft, const Correction& correction, std::int32_t face) {
  if (!correction.has("wall")) return draft.face_name(face);
  const std::string& name = correction.text("wall");
  return name.starts_with("wall ") ? name : "wall " + name;
}

void move_wall(CorrectionDraft& draft, const Correction& correction) {
  const std::int32_t room = draft.room_of(correction), face = draft.face_of(correction, room);
  const std::string called = wall_called(draft, correction, face);
  const double by = correction.number("by");
  const Eigen::Vector3d outwards = -draft.face(face).plane.normal * by;
  std::map<std::int32_t, double> shifts;
  std::set<std::int32_t> rooms;
  for (const auto f : correction.yes("both") ? whole_wall(draft, face) : std::set<std::int32_t>{face}) {
    if (draft.face(f).room < 0) continue;
    shifts[f] = draft.face(f).plane.normal.dot(outwards);
    rooms.insert(draft.face(f).room);
  }
  const std::vector<std::int32_t> moved(rooms.begin(), rooms.end());
  const Overlap before = overlap_of(draft.building, moved);
  const std::vector<BuildingFace> faces = draft.building.faces;
  shift_faces(draft, correction, shifts);
  if (!correction.yes("both")) keep_far_sides(draft, correction, faces);
  settle_rooms(draft, correction, moved, before);
  for (const auto r : moved)
    draft.mark(r, r == room
                      ? fmt::format("{} moved by {:.3f} m", called, by)
                      : fmt::format("{} of {} moved by {:.3f} m with the wall", called, draft.room(room).name, by));
}

void set_ceiling(CorrectionDraft& draft, const Correction& correction) {
  const std::int32_t room = draft.room_of(correction);
  const auto ceilings = levels_meant(draft, correction, room, SurfaceClass::ceiling);
  double by = correction.number_or("by", 0);
  if (correction.has("height")) {
    // The clear height is over the largest floor.
    double floor = 0, most = -1;
    for (const auto f : draft.room(room).faces) {
      const BuildingFace& face = draft.face(f);
      const double area = flat_polygon(draft.building, face).area();
      if (face.surface != SurfaceClass::floor || area <= most) continue;
      most = area;
      floor = height_of(draft, correction, {f}, "height");
    }
    by = floor + correction.number("height") - height_of(draft, correction, ceilings, "height");
  }
  raise(draft, correction, room, ceilings, by);
  draft.mark(room, correction.has("height")
                       ? fmt::format("ceiling set to a height of {:.3f} m", correction.number("height"))
                       : fmt::format("ceiling raised by {:.3f} m", by));
}

void set_floor(CorrectionDraft& draft, const Correction& correction) {
  const std::int32_t room = draft.room_of(correction);
  const auto floors = levels_meant(draft, correction, room, SurfaceClass::floor);
  double by = correction.number_or("by", 0);
  if (correction.has("level"))
    by = draft.building.storeys[static_cast<std::size_t>(draft.room(room).storey)].elevation +
         correction.number("level") - height_of(draft, correction, floors, "level");
  raise(draft, correction, room, floors, by);
  draft.mark(room, fmt::format("floor raised by {:.3f} m", by));
}

}  // namespace atrium::building
