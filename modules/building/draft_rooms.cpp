#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "modules/building/correction_draft.hpp"
#include "modules/layout/kept_rooms.hpp"
#include "modules/layout/wall_pairs.hpp"

namespace atrium::building {
namespace {

bool is_among(std::int32_t value, const std::vector<std::int32_t>& values) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

Eigen::Vector3d middle_of(const std::vector<Eigen::Vector3d>& places) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& p : places) sum += p;
  return sum / static_cast<double>(std::max<std::size_t>(places.size(), 1));
}

/// New numbers of what is kept.
std::vector<std::int32_t> numbers_of(const std::vector<bool>& kept) {
  std::vector<std::int32_t> result;
  result.reserve(kept.size());
  std::int32_t next = 0;
  for (const bool keep : kept) result.push_back(keep ? next++ : -1);
  return result;
}

}  // namespace

void CorrectionDraft::mark_new_shape(const Correction& correction, BuildingFace& face,
                                     const std::vector<std::int32_t>& sources, double area) const {
  constexpr double rounding = 1e-4;  // square metres
  double before = 0;
  for (const auto f : sources) before += flat_polygon(building, building.faces[static_cast<std::size_t>(f)]).area();
  if (sources.empty())
    face.corrections.push_back("new, by " + correction.name);
  else if (std::abs(area - before) > rounding)
    face.corrections.push_back("other shape, by " + correction.name);
}

std::int32_t CorrectionDraft::append(const Correction& correction, NewRoom added,
                                     std::vector<std::vector<std::int32_t>>& sources) {
  const auto index = static_cast<std::int32_t>(building.rooms.size());
  const auto base = static_cast<std::uint32_t>(building.vertices.size());
  building.vertices.insert(building.vertices.end(), added.shell.vertices.begin(), added.shell.vertices.end());
  added.room.faces.clear();
  for (std::size_t f = 0; f < added.shell.faces.size(); ++f) {
    BuildingFace face = added.shell.faces[f];
    face.room = index;
    face.storey = added.room.storey;
    for (auto& v : face.outline) v += base;
    for (auto& hole : face.holes)
      for (auto& v : hole) v += base;
    mark_new_shape(correction, face, added.shell.sources[f], flat_polygon(building, face).area());
    added.room.faces.push_back(static_cast<std::int32_t>(building.faces.size()));
    building.faces.push_back(std::move(face));
    sources.push_back(added.shell.sources[f]);
  }
  building.rooms.push_back(std::move(added.room));
  return index;
}

std::int32_t CorrectionDraft::successor(std::int32_t face, const std::vector<std::int32_t>& rooms,
                                        const std::vector<std::vector<std::int32_t>>& sources,
                                        const std::vector<Eigen::Vector3d>* outline) const {
  std::int32_t best = -1;
  double most = 0;
  for (const auto r : rooms)
    for (const auto f : building.rooms[static_cast<std::size_t>(r)].faces) {
      const BuildingFace& candidate = building.faces[static_cast<std::size_t>(f)];
      if (!is_among(face, sources[static_cast<std::size_t>(f)])) continue;
      if (outline != nullptr && !layout::face_contains(building, candidate, middle_of(*outline), 0)) continue;
      const double area = flat_polygon(building, candidate).area();
      if (area <= most) continue;
      most = area;
      best = f;
    }
  return best;
}

void CorrectionDraft::move_openings(const Correction& correction, const std::vector<std::int32_t>& removed,
                                    const std::vector<std::int32_t>& rooms,
                                    const std::vector<std::vector<std::int32_t>>& sources) {
  for (std::size_t o = 0; o < building.openings.size(); ++o) {
    BuildingOpening& opening = building.openings[o];
    const auto side = [&](std::int32_t& face, std::int32_t& room, const std::vector<Eigen::Vector3d>& outline) {
      if (face < 0 || !is_among(building.faces[static_cast<std::size_t>(face)].room, removed)) return;
      const std::int32_t next = successor(face, rooms, sources, &outline);
      if (next < 0)
        correction.fail({}, fmt::format("{} lies in what goes", opening_name(static_cast<std::int32_t>(o))),
                        "drop or move it first, with drop_opening or change_opening");
      face = next;
      room = building.faces[static_cast<std::size_t>(next)].room;
    };
    side(opening.face_a, opening.room_a, opening.outline_a);
    side(opening.face_b, opening.room_b, opening.outline_b);
  }
}

std::vector<std::int32_t> CorrectionDraft::replace(const Correction& correction,
                                                   const std::vector<std::int32_t>& removed,
                                                   std::vector<NewRoom> rooms) {
  std::vector<std::vector<std::int32_t>> sources(building.faces.size());
  std::vector<std::int32_t> added;
  added.reserve(rooms.size());
  for (auto& next : rooms) added.push_back(append(correction, std::move(next), sources));
  move_openings(correction, removed, added, sources);
  for (auto& now : faces_now_)
    if (now >= 0 && is_among(face(now).room, removed)) now = successor(now, added, sources, nullptr);
  std::vector<bool> rooms_kept, faces_kept, openings_kept;
  for (std::size_t r = 0; r < building.rooms.size(); ++r)
    rooms_kept.push_back(!is_among(static_cast<std::int32_t>(r), removed));
  for (const auto& f : building.faces) faces_kept.push_back(f.room < 0 || rooms_kept[static_cast<std::size_t>(f.room)]);
  for (const auto& o : building.openings) openings_kept.push_back(o.face_a >= 0 || o.face_b >= 0);
  const auto room_numbers = numbers_of(rooms_kept), face_numbers = numbers_of(faces_kept),
             opening_numbers = numbers_of(openings_kept);
  building.walls.clear();  // found again when all is done
  building = layout::with_rooms(building, rooms_kept);
  for (auto& now : faces_now_) now = now < 0 ? -1 : face_numbers[static_cast<std::size_t>(now)];
  for (auto& now : openings_now_) now = now < 0 ? -1 : opening_numbers[static_cast<std::size_t>(now)];
  for (auto& r : added) r = room_numbers[static_cast<std::size_t>(r)];
  return added;
}

}  // namespace atrium::building
