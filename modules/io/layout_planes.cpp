#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <optional>

#include "modules/io/truth_json.hpp"

namespace atrium::io {
namespace {

using V = Eigen::Vector3d;
using Ring = std::vector<V>;

constexpr double reach = 0.3;             // metres between a wall's end and the next one's beginning
constexpr double least_turn = 0.17;       // radians: flatter corners stand between the ends, not on the lines
constexpr double opening_distance = 0.2;  // metres from an opening to its wall

struct Labelled {
  std::string label;
  Ring corners;  // counter-clockwise seen from the room
};

// The lower side of a wall, with the room on its left.
struct Wall {
  Eigen::Vector2d from, to;
  double bottom;
  Eigen::Vector2d direction() const { return (to - from).normalized(); }
};

Wall wall_of(const Ring& corners) {
  // The side with the lowest middle; corners run counter-clockwise seen from the room, so it runs to the right there.
  std::size_t lowest = 0;
  const auto height = [&](std::size_t i) { return corners[i].z() + corners[(i + 1) % corners.size()].z(); };
  for (std::size_t i = 1; i < corners.size(); ++i)
    if (height(i) < height(lowest)) lowest = i;
  const V &a = corners[lowest], &b = corners[(lowest + 1) % corners.size()];
  return {b.head<2>(), a.head<2>(), height(lowest) / 2};
}

Eigen::Vector2d corner_between(const Wall& a, const Wall& b) {
  const Eigen::Vector2d d = a.direction(), e = b.direction();
  Eigen::Vector2d middle = (a.to + b.from) / 2;
  const double sine = d.x() * e.y() - d.y() * e.x();
  if (std::abs(sine) < std::sin(least_turn)) return middle;
  const Eigen::Vector2d gap = b.from - a.to;
  const Eigen::Vector2d meeting = a.to + d * ((gap.x() * e.y() - gap.y() * e.x()) / sine);
  return (meeting - middle).norm() <= reach ? meeting : middle;
}

struct Outline {
  std::vector<Eigen::Vector2d> corners;
  double bottom = 0;
};

// Follows walls from end to beginning. What does not close is no room.
std::vector<Outline> outlines_of(std::vector<Wall> walls, std::size_t& left_over) {
  std::vector<Outline> result;
  while (!walls.empty()) {
    std::vector<Wall> chain{walls.front()};
    walls.erase(walls.begin());
    const auto closed = [&] { return chain.size() > 2 && (chain.back().to - chain.front().from).norm() <= reach; };
    while (!walls.empty()) {
      const auto gap = [&](const Wall& w) { return (w.from - chain.back().to).norm(); };
      const auto next =
          std::min_element(walls.begin(), walls.end(), [&](const Wall& a, const Wall& b) { return gap(a) < gap(b); });
      if (gap(*next) > reach || (closed() && (chain.back().to - chain.front().from).norm() <= gap(*next))) break;
      chain.push_back(*next);
      walls.erase(next);
    }
    if (!closed()) {
      left_over += chain.size();
      continue;
    }
    Outline outline;
    for (std::size_t i = 0; i < chain.size(); ++i) {
      outline.corners.push_back(corner_between(chain[(i + chain.size() - 1) % chain.size()], chain[i]));
      outline.bottom += chain[i].bottom / static_cast<double>(chain.size());
    }
    result.push_back(outline);
  }
  return result;
}

// The outline on the labelled surface that is nearest in height; none where there is none.
std::optional<Ring> lifted(const Outline& outline, const std::vector<Labelled>& surfaces, const std::string& label) {
  Ring ring;
  const Labelled* best = nullptr;
  double nearest = 0;
  for (const auto& s : surfaces) {
    if (s.label != label) continue;
    const double distance = std::abs(s.corners.front().z() - outline.bottom);
    if (best != nullptr && distance >= nearest) continue;
    best = &s;
    nearest = distance;
  }
  if (best == nullptr) return {};
  const auto face = face_of(SurfaceClass::floor, -1, 0, best->corners);
  const V& n = face.plane.normal;
  for (const auto& p : outline.corners)
    ring.emplace_back(p.x(), p.y(), -(face.plane.offset + n.x() * p.x() + n.y() * p.y()) / n.z());
  return ring;
}

void add_opening(GroundTruth& truth, const Labelled& frame) {
  TrueOpening opening;
  opening.kind = frame.label == "DOOR_FRAME" ? "door" : "window";
  opening.outline = frame.corners;
  V middle = V::Zero();
  for (const auto& p : frame.corners) middle += p / static_cast<double>(frame.corners.size());
  double nearest = opening_distance;
  for (std::size_t f = 0; f < truth.faces.size(); ++f) {
    const TrueFace& face = truth.faces[f];
    if (face.surface != SurfaceClass::wall || face.plane.normal.dot(area_vector(frame.corners).normalized()) < 0.9)
      continue;
    const Wall wall = wall_of(face.outline);
    const double along = wall.direction().dot(middle.head<2>() - wall.from);
    if (along < 0 || along > (wall.to - wall.from).norm()) continue;
    const double distance = std::abs(face.plane.signed_distance(middle));
    if (distance >= nearest) continue;
    nearest = distance;
    opening.face_a = static_cast<std::int32_t>(f);
    opening.room_a = face.room;
  }
  truth.openings.push_back(opening);
}

std::vector<Labelled> labelled_planes(const JsonField& root) {
  std::vector<Labelled> result;
  for (const auto& field : root["planes"].items()) {
    Labelled plane{field["label"].text(), field["corners"].ring()};
    const V out = field["normal_out"].place();
    if (!(area_vector(plane.corners).norm() > 0)) field["corners"].fail("have no area");
    if (area_vector(plane.corners).dot(out) > 0) std::reverse(plane.corners.begin(), plane.corners.end());
    if ((plane.label == "FLOOR" || plane.label == "CEILING") && std::abs(out.normalized().z()) < 0.5)
      field["normal_out"].fail("is not upright");
    result.push_back(std::move(plane));
  }
  return result;
}

}  // namespace

GroundTruth truth_from_planes(const JsonField& root, const std::string& path, const Context& context) {
  if (root.has("units") && root["units"].text() != "m")
    root["units"].fail("is not \"m\"", "convert the file to metres");
  if (root.has("up") && root["up"].text() != "z") root["up"].fail("is not \"z\"", "turn the file upright");
  const auto planes = labelled_planes(root);
  GroundTruth truth;
  std::vector<Wall> walls;
  for (const auto& p : planes) {
    if (p.label != "WALL_FACE") continue;
    walls.push_back(wall_of(p.corners));
    truth.faces.push_back(face_of(SurfaceClass::wall, -1, 0, p.corners));
  }
  std::size_t left_over = 0;
  const auto outlines = outlines_of(walls, left_over);
  if (left_over > 0)
    context.warn(path + ": " + std::to_string(left_over) + " walls close no room: their room has no outline");
  for (const auto& outline : outlines) {
    const auto room = static_cast<std::int32_t>(truth.rooms.size());
    Ring level;
    for (const auto& p : outline.corners) level.emplace_back(p.x(), p.y(), outline.bottom);
    const auto floor = lifted(outline, planes, "FLOOR");
    truth.rooms.push_back({"room " + std::to_string(room + 1), 0, floor.value_or(level)});
    if (floor) truth.faces.push_back(face_of(SurfaceClass::floor, room, 0, *floor));
    auto ceiling = lifted(outline, planes, "CEILING");
    if (!ceiling) continue;
    std::reverse(ceiling->begin(), ceiling->end());
    truth.faces.push_back(face_of(SurfaceClass::ceiling, room, 0, *ceiling));
  }
  if (outlines.size() == 1)
    for (auto& face : truth.faces) face.room = 0;
  for (const auto& p : planes) {
    if (outlines.empty() && (p.label == "FLOOR" || p.label == "CEILING"))
      truth.faces.push_back(
          face_of(p.label == "FLOOR" ? SurfaceClass::floor : SurfaceClass::ceiling, -1, 0, p.corners));
    if (p.label == "DOOR_FRAME" || p.label == "WINDOW_FRAME") add_opening(truth, p);
  }
  truth.mesh = mesh_of(truth);
  return truth;
}

}  // namespace atrium::io
