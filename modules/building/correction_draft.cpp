#include "modules/building/correction_draft.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "graph/api/suggest.hpp"
#include "modules/building/ifc_context.hpp"
#include "modules/building/upright_building.hpp"
#include "modules/types/building_rules.hpp"

namespace atrium::building {
namespace {

/// Two rooms of a foreign file may share corners; what moves one must not move the other.
void part_rooms(Building& building) {
  std::map<std::uint32_t, std::int32_t> owners;
  std::map<std::pair<std::uint32_t, std::int32_t>, std::uint32_t> copies;
  for (auto& face : building.faces) {
    const auto own = [&](std::uint32_t& v) {
      if (owners.emplace(v, face.room).first->second == face.room) return;
      const auto [it, is_new] =
          copies.emplace(std::pair(v, face.room), static_cast<std::uint32_t>(building.vertices.size()));
      if (is_new) building.vertices.push_back(Eigen::Vector3d(building.vertices[v]));
      v = it->second;
    };
    for (auto& v : face.outline) own(v);
    for (auto& hole : face.holes)
      for (auto& v : hole) own(v);
  }
}

double plan_distance(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d side = b - a;
  const double t = std::clamp(side.dot(p - a) / std::max(side.squaredNorm(), 1e-12), 0.0, 1.0);
  return (p - a - t * side).norm();
}

}  // namespace

CorrectionDraft::CorrectionDraft(const Building& original, const Transform& transform, double unit, double thickness)
    : building(original),
      max_thickness(thickness),
      original_(original),
      transform_(transform),
      unit_(unit),
      opening_names_(opening_names(original)) {
  part_rooms(building);
  for (std::size_t f = 0; f < original.faces.size(); ++f) faces_now_.push_back(static_cast<std::int32_t>(f));
  for (std::size_t o = 0; o < original.openings.size(); ++o) openings_now_.push_back(static_cast<std::int32_t>(o));
}

std::int32_t CorrectionDraft::room_named(const Correction& correction, std::string_view key,
                                         const std::string& name) const {
  std::vector<std::string> names;
  std::int32_t found = -1;
  const auto look = [&](const std::string& wanted) {
    for (std::size_t r = 0; r < building.rooms.size(); ++r) {
      if (building.rooms[r].name != wanted) continue;
      if (found >= 0)
        correction.fail(key, fmt::format("there are several rooms '{}'", wanted), "rename one in the input");
      found = static_cast<std::int32_t>(r);
    }
  };
  look(name);
  if (const auto later = renamed_.find(name); found < 0 && later != renamed_.end()) look(later->second);
  if (found >= 0) return found;
  for (const auto& room : building.rooms) names.push_back(room.name);
  const std::string hint = did_you_mean(name, names);
  correction.fail(key, fmt::format("there is no room '{}'", name),
                  hint.empty() ? "rooms: " + join_words(names, 20) : hint);
}

std::int32_t CorrectionDraft::room_of(const Correction& correction) const {
  if (!correction.has("room")) return room_at(correction, {"near"});
  const std::int32_t room = room_named(correction, "room", correction.text("room"));
  check_room_place(correction, {correction.has("at") ? "at" : "near"}, room);
  return room;
}

std::vector<std::int32_t> CorrectionDraft::rooms_of(const Correction& correction) const {
  std::vector<std::int32_t> rooms;
  rooms.reserve(2);
  for (std::size_t i = 0; i < 2; ++i) {
    const PlaceKey near{"near", i};
    if (!correction.has("rooms")) {
      rooms.push_back(room_at(correction, near));
      continue;
    }
    rooms.push_back(room_named(correction, "rooms", correction.at("rooms").texts[i]));
    check_room_place(correction, near, rooms.back());
  }
  return rooms;
}

std::string CorrectionDraft::face_name(std::int32_t face) const {
  const auto found = std::find(faces_now_.begin(), faces_now_.end(), face);
  return found == faces_now_.end() ? "a new face" : fmt::format("face {}", found - faces_now_.begin());
}

std::string CorrectionDraft::opening_name(std::int32_t opening) const {
  const auto found = std::find(openings_now_.begin(), openings_now_.end(), opening);
  if (found != openings_now_.end()) return opening_names_[static_cast<std::size_t>(found - openings_now_.begin())];
  return "the added " + building.openings[static_cast<std::size_t>(opening)].kind;
}

std::string CorrectionDraft::walls_of(std::int32_t room) const {
  std::vector<std::string> names;
  for (const auto f : building.rooms[static_cast<std::size_t>(room)].faces)
    if (building.faces[static_cast<std::size_t>(f)].surface == SurfaceClass::wall) names.push_back(face_name(f));
  return "its walls: " + join_words(names, 20);
}

std::int32_t CorrectionDraft::numbered_face(const Correction& correction, std::int32_t room) const {
  const double number = correction.number("face");
  const std::string& name = building.rooms[static_cast<std::size_t>(room)].name;
  if (number >= static_cast<double>(faces_now_.size()))
    correction.fail("face", fmt::format("there is no face {}", number),
                    fmt::format("building.json counts {} faces from 0", faces_now_.size()));
  const std::int32_t face = faces_now_[static_cast<std::size_t>(number)];
  if (face < 0)
    correction.fail("face", fmt::format("face {} is no more: a correction before this one took it away", number));
  if (building.faces[static_cast<std::size_t>(face)].room != room)
    correction.fail("face", fmt::format("face {} is none of '{}'", number, name),
                    "numbers are those of building.json before all corrections; " + walls_of(room));
  check_face_place(correction, static_cast<std::size_t>(number), fmt::format("face {}", number));
  return face;
}

std::int32_t CorrectionDraft::face_by_wall(const Correction& correction, std::int32_t room) {
  if (!elements_) {
    ElementLimits limits;
    limits.max_thickness = max_thickness;
    elements_ = elements_of(upright_building(original_, transform_, true).building, limits);
  }
  std::string_view text = correction.text("wall");
  if (text.starts_with("wall ")) text.remove_prefix(5);
  std::size_t number = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
  const std::size_t count = elements_->walls.size();
  if (problem != std::errc{} || end != text.data() + text.size() || number < 1 || number > count)
    correction.fail("wall", fmt::format("there is no '{}'", correction.text("wall")),
                    fmt::format("walls.csv lists wall 1 to wall {}", count));
  std::vector<std::int32_t> faces;
  std::size_t before = 0;
  for (const auto f : elements_->walls[number - 1].faces) {
    const std::int32_t now = faces_now_[static_cast<std::size_t>(f)];
    if (now < 0 || building.faces[static_cast<std::size_t>(now)].room != room) continue;
    faces.push_back(now);
    before = static_cast<std::size_t>(f);
  }
  const std::string& name = building.rooms[static_cast<std::size_t>(room)].name;
  if (faces.empty())
    correction.fail("wall", fmt::format("wall {} has no face in '{}'", number, name),
                    "numbers are those of walls.csv before all corrections; " + walls_of(room));
  if (faces.size() > 1)
    correction.fail("wall", fmt::format("'{}' is on both sides of wall {}", name, number),
                    fmt::format("give `face`: {} or {}", face_name(faces[0]), face_name(faces[1])));
  check_face_place(correction, before, fmt::format("wall {}", number));
  return faces.front();
}

std::int32_t CorrectionDraft::face_by_place(const Correction& correction, std::int32_t room) const {
  constexpr double reach = 1, corner = 0.02;  // metres
  const BuildingRoom& owner = building.rooms[static_cast<std::size_t>(room)];
  double low = 1e300;
  for (const auto& p : owner.outline) low = std::min(low, p.z());
  const Eigen::Vector3d at = place(correction, "at", low);
  struct Near {
    std::int32_t face;
    double distance, area;
  };
  std::vector<Near> all;
  for (const auto f : owner.faces) {
    const BuildingFace& face = building.faces[static_cast<std::size_t>(f)];
    if (face.surface != SurfaceClass::wall) continue;
    double least = 1e300;
    for (std::size_t i = 0; i < face.outline.size(); ++i)
      least = std::min(least, plan_distance(at.head<2>(), building.vertices[face.outline[i]].head<2>(),
                                            building.vertices[face.outline[(i + 1) % face.outline.size()]].head<2>()));
    all.push_back({f, least, flat_polygon(building, face).area()});
  }
  std::sort(all.begin(), all.end(), [](const Near& a, const Near& b) { return a.distance < b.distance; });
  if (all.empty() || all.front().distance > reach)
    correction.fail("at", fmt::format("no wall of '{}' is within {} m of that place", owner.name, reach),
                    "places are those of the scan, in its unit; " + walls_of(room));
  // Of faces over each other the largest is meant; of two that meet in a corner nobody knows.
  Near best = all.front();
  for (const auto& other : all) {
    if (other.distance > all.front().distance + corner) break;
    const Plane &a = building.faces[static_cast<std::size_t>(best.face)].plane,
                &b = building.faces[static_cast<std::size_t>(other.face)].plane;
    if (a.normal.dot(b.normal) < 0.99)
      correction.fail(
          "at", fmt::format("that place is in the corner of {} and {}", face_name(best.face), face_name(other.face)),
          "give one at the middle of the wall");
    if (other.area > best.area) best = other;
  }
  return best.face;
}

std::int32_t CorrectionDraft::face_of(const Correction& correction, std::int32_t room) {
  const std::int32_t face = correction.has("face")   ? numbered_face(correction, room)
                            : correction.has("wall") ? face_by_wall(correction, room)
                                                     : face_by_place(correction, room);
  if (this->face(face).surface != SurfaceClass::wall)
    correction.fail("face", fmt::format("{} is a {}, not a wall", face_name(face), name_of(this->face(face).surface)),
                    walls_of(room));
  return face;
}

std::int32_t CorrectionDraft::opening_of(const Correction& correction) const {
  if (!correction.has("opening")) {
    const std::int32_t index = opening_at(correction), now = openings_now_[static_cast<std::size_t>(index)];
    if (now < 0)
      correction.fail("near", fmt::format("'{}' is no more: a correction before this one took it away",
                                          opening_names_[static_cast<std::size_t>(index)]));
    return now;
  }
  const std::string& name = correction.text("opening");
  const auto found = std::find(opening_names_.begin(), opening_names_.end(), name);
  if (found == opening_names_.end()) {
    const std::string hint = did_you_mean(name, opening_names_);
    correction.fail("opening", fmt::format("there is no '{}'", name),
                    !hint.empty() ? hint : "as named in doors.csv and windows.csv: " + join_words(opening_names_, 20));
  }
  const auto index = static_cast<std::size_t>(found - opening_names_.begin());
  if (correction.has("near")) check_opening_place(correction, index);
  const std::int32_t now = openings_now_[index];
  if (now < 0)
    correction.fail("opening", fmt::format("'{}' is no more: a correction before this one took it away", name));
  return now;
}

Eigen::Vector3d CorrectionDraft::place(const Correction& correction, std::string_view key, double height) const {
  return place_at(correction, key, correction.at(key).numbers, height);
}

Eigen::Vector3d CorrectionDraft::place_at(const Correction& correction, std::string_view key,
                                          const std::vector<double>& numbers, double height) const {
  const auto turned = [&](double x, double y, double z) -> Eigen::Vector3d {
    return transform_.rotation * Eigen::Vector3d(x, y, z) + transform_.translation - building.origin;
  };
  const double x = numbers[0] * unit_, y = numbers[1] * unit_;
  if (numbers.size() == 3) return turned(x, y, numbers[2] * unit_);
  const double rise = transform_.rotation(2, 2);
  constexpr double upright = 0.7;
  if (std::abs(rise) < upright)
    correction.fail(key, "z does not point up in the scan's frame: two numbers are no place in its plan",
                    "give three, [x, y, z]");
  return turned(x, y, (height - turned(x, y, 0).z()) / rise);
}

std::string CorrectionDraft::told(const Eigen::Vector3d& place) const {
  const Transform back = inverse(transform_);
  const Eigen::Vector3d p = (back.rotation * (building.origin + place) + back.translation) / unit_;
  return fmt::format("x {:.2f}, y {:.2f}", p.x(), p.y());
}

void CorrectionDraft::rename(std::int32_t index, const std::string& name) {
  for (auto& [before, now] : renamed_)
    if (now == room(index).name) now = name;
  renamed_[room(index).name] = name;
  room(index).name = name;
}

void CorrectionDraft::mark(std::int32_t index, const std::string& what) {
  if (index >= 0) room(index).doubts.push_back("corrected by hand: " + what);
}

void CorrectionDraft::drop_opening(std::int32_t index) {
  building.openings.erase(building.openings.begin() + index);
  for (auto& now : openings_now_) now = now == index ? -1 : now > index ? now - 1 : now;
}

}  // namespace atrium::building
