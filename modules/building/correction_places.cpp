// What a correction's `near` says: where the thing is that it names, or which one is meant.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "modules/building/correction_draft.hpp"

namespace atrium::building {
namespace {

constexpr double reach = 0.3;        // metres from a place to what is named beside it
constexpr double wide_reach = 0.5;   // metres from a place to what it alone means
constexpr double slack = 0.05;       // metres that something else may be nearer
constexpr double deep = 0.02;        // metres inside another room
constexpr double same_room = 0.02;   // metres between two rooms that are equally near
constexpr double same_place = 0.10;  // metres between two openings that are equally near

constexpr const char* numbers_change = "numbers change with the program and its parameters";

struct NearestTwo {
  std::size_t index = 0, second = 0;
  double distance = std::numeric_limits<double>::infinity(), second_distance = distance;

  void take(std::size_t i, double d) {
    if (d < distance) {
      second = index;
      second_distance = distance;
      index = i;
      distance = d;
    } else if (d < second_distance) {
      second = i;
      second_distance = d;
    }
  }
};

std::string what_is_nearest(const std::string& name, double distance, bool named_itself) {
  return named_itself
             ? fmt::format("nothing else is nearer to that place; {}", numbers_change)
             : fmt::format("the nearest to that place is {}, {:.2f} m from it; {}", name, distance, numbers_change);
}

std::int32_t storey_with(const Building& building, const BuildingOpening& opening) {
  const std::int32_t face = opening.face_a >= 0 ? opening.face_a : opening.face_b;
  return face < 0 ? -1 : building.faces[static_cast<std::size_t>(face)].storey;
}

Eigen::Vector3d centre_at(const std::vector<Eigen::Vector3d>& ring) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& p : ring) sum += p;
  return ring.empty() ? sum : Eigen::Vector3d(sum / static_cast<double>(ring.size()));
}

Eigen::Vector3d centre_at(const BuildingOpening& opening) {
  return centre_at(opening.outline_a.empty() ? opening.outline_b : opening.outline_a);
}

Eigen::Vector3d centre_at(const Building& building, const BuildingFace& face) {
  std::vector<Eigen::Vector3d> ring;
  ring.reserve(face.outline.size());
  for (const auto v : face.outline) ring.push_back(building.vertices[v]);
  return centre_at(ring);
}

}  // namespace

NearPlace CorrectionDraft::near_place(const Correction& correction, const PlaceKey& key, double height) const {
  const CorrectionValue& value = correction.at(key.name);
  const auto& numbers = value.places.empty() ? value.numbers : value.places[key.thing];
  return {place_at(correction, key.name, numbers, height), numbers.size() == 3};
}

void CorrectionDraft::check_opening_place(const Correction& correction, std::size_t named) const {
  const PlaceKey key{"near"};
  const BuildingOpening& opening = original_.openings[named];
  const auto distance = [&](const BuildingOpening& other) {
    return distance_to(near_place(correction, key, centre_at(other).z()), other);
  };
  NearestTwo nearest;
  for (std::size_t o = 0; o < original_.openings.size(); ++o) {
    const BuildingOpening& other = original_.openings[o];
    if (correction.at(key.name).places[0].size() == 3 ||
        storey_with(original_, other) == storey_with(original_, opening))
      nearest.take(o, distance(other));
  }
  const double off = distance(opening);
  if (off <= reach && off <= nearest.distance + slack) return;
  const std::string& there = opening_names_[nearest.index];
  correction.fail(
      key.name,
      fmt::format("{} is {:.2f} m from that place: it is at {}", opening_names_[named], off, told(centre_at(opening))),
      nearest.distance <= reach
          ? fmt::format("{0} is there: if it is meant, give `opening: {0}`; {1}", there, numbers_change)
          : what_is_nearest(there, nearest.distance, nearest.index == named));
}

std::int32_t CorrectionDraft::opening_at(const Correction& correction) const {
  const PlaceKey key{"near"};
  NearestTwo nearest;
  for (std::size_t o = 0; o < original_.openings.size(); ++o) {
    const BuildingOpening& opening = original_.openings[o];
    nearest.take(o, distance_to(near_place(correction, key, centre_at(opening).z()), opening));
  }
  if (original_.openings.empty()) correction.fail(key.name, "the building has no doors and windows");
  const std::string &name = opening_names_[nearest.index], &second = opening_names_[nearest.second];
  if (nearest.distance > wide_reach)
    correction.fail(key.name, fmt::format("no door or window is within {} m of that place", wide_reach),
                    fmt::format("the nearest is {}, {:.2f} m from it, at {}", name, nearest.distance,
                                told(centre_at(original_.openings[nearest.index]))));
  if (nearest.second_distance < nearest.distance + same_place)
    correction.fail(
        key.name,
        fmt::format("it is not clear which is meant: {} is {:.2f} m from that place, {} {:.2f} m", name,
                    nearest.distance, second, nearest.second_distance),
        fmt::format("name it with `opening`, or give a place nearer to it{}",
                    correction.at(key.name).places[0].size() == 2 ? ", with its height as third number" : ""));
  return static_cast<std::int32_t>(nearest.index);
}

void CorrectionDraft::check_face_place(const Correction& correction, std::size_t named,
                                       const std::string& called) const {
  if (!correction.has("near")) return;
  const PlaceKey key{"near"};
  const BuildingFace& face = original_.faces[named];
  const auto distance = [&](const BuildingFace& other) {
    return distance_to(near_place(correction, key, centre_at(original_, other).z()), original_, other);
  };
  NearestTwo nearest;
  for (std::size_t f = 0; f < original_.faces.size(); ++f) {
    const BuildingFace& other = original_.faces[f];
    if (other.surface != face.surface || other.room < 0) continue;
    if (correction.at(key.name).places[0].size() == 3 || other.storey == face.storey) nearest.take(f, distance(other));
  }
  const double off = distance(face);
  if (off <= reach && off <= nearest.distance + slack) return;
  const std::string there =
      fmt::format("face {} of '{}'", nearest.index,
                  original_.rooms[static_cast<std::size_t>(original_.faces[nearest.index].room)].name);
  correction.fail(
      key.name,
      fmt::format("{} is {:.2f} m from that place: its middle is at {}", called, off, told(centre_at(original_, face))),
      nearest.distance <= reach ? fmt::format("at that place is {}; {}", there, numbers_change)
                                : what_is_nearest(there, nearest.distance, nearest.index == named));
}

bool CorrectionDraft::is_at(const Building& of, const Correction& correction, const PlaceKey& key,
                            std::int32_t index) const {
  const BuildingRoom& named = of.rooms[static_cast<std::size_t>(index)];
  const NearPlace place = near_place(correction, key, centre_at(named.outline).z());
  const bool of_wall = correction.has("at") || correction.has("wall") || correction.has("face");
  const double off = distance_to(place, of, named);
  if (!of_wall && off > reach) return false;
  return off == 0 || std::none_of(of.rooms.begin(), of.rooms.end(), [&](const BuildingRoom& other) {
           return &other != &named && (place.has_height || other.storey == named.storey) &&
                  depth_in(place, of, other) > deep;
         });
}

std::int32_t CorrectionDraft::original_room(std::int32_t index) const {
  const std::string& now = building.rooms[static_cast<std::size_t>(index)].name;
  const auto renamed =
      std::find_if(renamed_.begin(), renamed_.end(), [&](const auto& names) { return names.second == now; });
  const std::string& before = renamed == renamed_.end() ? now : renamed->first;
  for (std::size_t r = 0; r < original_.rooms.size(); ++r)
    if (original_.rooms[r].name == before) return static_cast<std::int32_t>(r);
  return -1;
}

void CorrectionDraft::check_room_place(const Correction& correction, const PlaceKey& key, std::int32_t index) const {
  if (!correction.has(key.name) || is_at(building, correction, key, index)) return;
  // A correction before this one may have moved its walls.
  const std::int32_t before = original_room(index);
  if (before >= 0 && is_at(original_, correction, key, before)) return;
  const BuildingRoom& named = building.rooms[static_cast<std::size_t>(index)];
  const NearPlace place = near_place(correction, key, centre_at(named.outline).z());
  NearestTwo nearest;
  for (std::size_t r = 0; r < building.rooms.size(); ++r)
    if (place.has_height || building.rooms[r].storey == named.storey)
      nearest.take(r, distance_to(place, building, building.rooms[r]));
  const std::string& there = building.rooms[nearest.index].name;
  const std::string problem =
      fmt::format("'{}' is {:.2f} m from that place", named.name, distance_to(place, building, named));
  correction.fail(key.name, problem,
                  nearest.distance == 0 ? fmt::format("'{}' is there; {}", there, numbers_change)
                                        : what_is_nearest(fmt::format("'{}'", there), nearest.distance,
                                                          static_cast<std::int32_t>(nearest.index) == index));
}

std::int32_t CorrectionDraft::room_at(const Correction& correction, const PlaceKey& key) const {
  NearestTwo nearest;
  for (std::size_t r = 0; r < building.rooms.size(); ++r) {
    const BuildingRoom& room = building.rooms[r];
    nearest.take(r, distance_to(near_place(correction, key, centre_at(room.outline).z()), building, room));
  }
  if (building.rooms.empty()) correction.fail(key.name, "the building has no rooms");
  const std::string& name = building.rooms[nearest.index].name;
  if (nearest.distance > wide_reach)
    correction.fail(key.name, fmt::format("no room is within {} m of that place", wide_reach),
                    fmt::format("the nearest is '{}', {:.2f} m from it", name, nearest.distance));
  if (nearest.second_distance < nearest.distance + same_room)
    correction.fail(key.name,
                    fmt::format("it is not clear which room is meant: '{}' and '{}' are at that place", name,
                                building.rooms[nearest.second].name),
                    "give a place in the middle of the room, with a height as third number where there are storeys");
  return static_cast<std::int32_t>(nearest.index);
}

}  // namespace atrium::building
