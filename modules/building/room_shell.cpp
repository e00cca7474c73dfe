#include "modules/building/room_shell.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "modules/building/shell_welding.hpp"
#include "modules/geometry/plane_frame.hpp"
#include "modules/layout/face_rings.hpp"

namespace atrium::building {
namespace {

using layout::Ring;

constexpr double plane_slack = 0.001;      // metres
constexpr double straight_corner = 0.001;  // metres
constexpr double least_face = 1e-6;        // square metres

bool same_plane(const ShellWelding& welding, const WeldedPiece& a, const WeldedPiece& b) {
  const BuildingFace &first = a.piece->face, &other = b.piece->face;
  constexpr double same_way = 0.999;
  if (first.surface != other.surface || first.plane.normal.dot(other.plane.normal) < same_way) return false;
  if (first.backing != other.backing) return false;  // who measured one wall has not measured the other
  return std::all_of(b.rings.begin(), b.rings.end(), [&](const Ring& ring) {
    return std::all_of(ring.begin(), ring.end(), [&](std::uint32_t v) {
      return std::abs(first.plane.signed_distance(welding.vertices[v])) < plane_slack;
    });
  });
}

/// What was seen of a face that is made from these pieces.
void take_evidence(const std::vector<const WeldedPiece*>& pieces, BuildingFace& face,
                   std::vector<std::int32_t>& sources) {
  double area = 0, seen = 0, squares = 0;
  for (const auto* piece : pieces) {
    const BuildingFace& from = piece->piece->face;
    area += piece->area;
    seen += piece->area * from.observed;
    squares += piece->area * from.observed * from.residual * from.residual;
    if (piece->piece->source >= 0) sources.push_back(piece->piece->source);
    for (const auto& done : from.corrections)
      if (std::find(face.corrections.begin(), face.corrections.end(), done) == face.corrections.end())
        face.corrections.push_back(done);
  }
  face.observed = area > 0 ? seen / area : 0;
  face.residual = seen > 0 ? std::sqrt(squares / seen) : 0;
}

/// Joins one plane's pieces into faces.
class PlaneJoining {
 public:
  PlaneJoining(const ShellWelding& welding, std::vector<const WeldedPiece*> group, RoomShell& shell)
      : welding_(welding), group_(std::move(group)), shell_(shell) {
    std::stable_sort(group_.begin(), group_.end(),
                     [](const WeldedPiece* a, const WeldedPiece* b) { return a->area > b->area; });
    normal_ = group_.front()->piece->face.plane.normal;
  }

  void run() {
    std::vector<Ring> all;
    for (const auto* piece : group_) all.insert(all.end(), piece->rings.begin(), piece->rings.end());
    std::vector<Ring> holes;
    const std::size_t first = shell_.faces.size();
    for (auto& ring : layout::joined_rings(all, welding_.vertices, normal_)) {
      const double area = layout::signed_area(ring, welding_.vertices, normal_);
      if (area > least_face)
        add_face(std::move(ring));
      else if (area < -least_face)
        holes.push_back(std::move(ring));
    }
    for (auto& hole : holes) place_hole(std::move(hole), first);
  }

 private:
  bool holds(const Ring& ring, const Eigen::Vector3d& place) const {
    return layout::ring_contains(ring, welding_.vertices, normal_, place);
  }
  void add_face(Ring ring) {
    std::vector<const WeldedPiece*> own;
    for (const auto* piece : group_) {
      // A side of the piece lies within the ring or on it: its middle, moved a little into the piece.
      const Ring& outline = piece->rings.front();
      const Eigen::Vector3d &a = welding_.vertices[outline[0]], &b = welding_.vertices[outline[1]];
      const Eigen::Vector3d inwards = normal_.cross(b - a).normalized();
      if (holds(ring, 0.5 * (a + b) + 1e-5 * inwards)) own.push_back(piece);
    }
    if (own.empty()) own.push_back(group_.front());
    BuildingFace face = own.front()->piece->face;
    face.outline = std::move(ring);
    face.holes.clear();
    take_evidence(own, face, shell_.sources.emplace_back());
    shell_.faces.push_back(std::move(face));
  }
  void place_hole(Ring hole, std::size_t first) {
    const Eigen::Vector3d middle = 0.5 * (welding_.vertices[hole[0]] + welding_.vertices[hole[1]]);
    BuildingFace* best = nullptr;
    double least = 0;
    for (std::size_t f = first; f < shell_.faces.size(); ++f) {
      const double area = layout::signed_area(shell_.faces[f].outline, welding_.vertices, normal_);
      if (!holds(shell_.faces[f].outline, middle) || (best != nullptr && area >= least)) continue;
      best = &shell_.faces[f];
      least = area;
    }
    if (best != nullptr) best->holes.push_back(std::move(hole));
  }

  const ShellWelding& welding_;
  std::vector<const WeldedPiece*> group_;
  RoomShell& shell_;
  Eigen::Vector3d normal_;
};

template <class Visit>
void each_shell_ring(RoomShell& shell, Visit visit) {
  for (auto& face : shell.faces) {
    visit(face.outline);
    for (auto& hole : face.holes) visit(hole);
  }
}

void drop_straight_corners(RoomShell& shell) {
  std::vector<const Ring*> rings;
  each_shell_ring(shell, [&](const Ring& ring) { rings.push_back(&ring); });
  const std::vector<bool> dropped = layout::straight_corners(rings, shell.vertices, straight_corner);
  std::map<std::uint32_t, std::uint32_t> numbers;
  std::vector<Eigen::Vector3d> vertices;
  each_shell_ring(shell, [&](Ring& ring) {
    std::erase_if(ring, [&](std::uint32_t v) { return dropped[v]; });
    for (auto& v : ring) {
      const auto [it, is_new] = numbers.emplace(v, static_cast<std::uint32_t>(vertices.size()));
      if (is_new) vertices.push_back(shell.vertices[v]);
      v = it->second;
    }
  });
  shell.vertices = std::move(vertices);
}

SurfaceClass class_by(const Eigen::Vector3d& normal) {
  constexpr double steep = 0.5;  // as layout.faces has it
  return normal.z() > steep ? SurfaceClass::floor : normal.z() < -steep ? SurfaceClass::ceiling : SurfaceClass::wall;
}

using Sides = std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>>;

Sides sides_of(const std::vector<BuildingFace>& faces) {
  Sides sides;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto add = [&](const Ring& ring) {
      for (std::size_t i = 0; i < ring.size(); ++i) sides[{ring[i], ring[(i + 1) % ring.size()]}].push_back(f);
    };
    add(faces[f].outline);
    for (const auto& hole : faces[f].holes) add(hole);
  }
  return sides;
}

}  // namespace

ShellPiece new_piece(std::vector<Eigen::Vector3d> outline, const Eigen::Vector3d& normal) {
  ShellPiece piece;
  piece.face.plane = {normal, -normal.dot(outline.front())};
  piece.face.surface = class_by(normal);
  piece.outline = std::move(outline);
  return piece;
}

ShellPiece part_of(const ShellPiece& whole, const PlaneFrame& frame, const PlanPolygon& polygon) {
  ShellPiece piece;
  piece.face = whole.face;
  piece.source = whole.source;
  const auto raised = [&](const PlanRing& ring) {
    std::vector<Eigen::Vector3d> result;
    result.reserve(ring.size());
    for (const auto& p : ring) result.push_back(frame.to_space(p));
    return result;
  };
  piece.outline = raised(polygon.outline);
  for (const auto& hole : polygon.holes) piece.holes.push_back(raised(hole));
  return piece;
}

PlaneFrame frame_of(const Building& building, const BuildingFace& face) {
  return upright_frame(face.plane, building.vertices[face.outline[0]]);
}

ShellPiece piece_of(const Building& building, std::int32_t index) {
  ShellPiece piece;
  piece.face = building.faces[static_cast<std::size_t>(index)];
  piece.source = index;
  const auto places = [&](const Ring& ring) {
    std::vector<Eigen::Vector3d> result;
    result.reserve(ring.size());
    for (const auto v : ring) result.push_back(building.vertices[v]);
    return result;
  };
  piece.outline = places(piece.face.outline);
  for (const auto& hole : piece.face.holes) piece.holes.push_back(places(hole));
  return piece;
}

std::vector<ShellPiece> pieces_of(const Building& building, const BuildingRoom& room) {
  std::vector<ShellPiece> pieces;
  pieces.reserve(room.faces.size());
  for (const auto f : room.faces) pieces.push_back(piece_of(building, f));
  return pieces;
}

RoomShell joined_shell(const std::vector<ShellPiece>& pieces) {
  const ShellWelding welding(pieces);
  std::vector<std::size_t> order(welding.pieces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return welding.pieces[a].area > welding.pieces[b].area; });
  // The largest piece of a plane says which plane that is.
  std::vector<std::size_t> plane_of(welding.pieces.size());
  std::vector<std::size_t> planes;
  for (const auto p : order) {
    const auto found = std::find_if(planes.begin(), planes.end(), [&](std::size_t q) {
      return same_plane(welding, welding.pieces[q], welding.pieces[p]);
    });
    plane_of[p] = found == planes.end() ? p : *found;
    if (found == planes.end()) planes.push_back(p);
  }
  RoomShell shell;
  shell.vertices = welding.vertices;
  for (std::size_t p = 0; p < plane_of.size(); ++p) {
    // Planes come in the order of their first pieces.
    if (std::find(plane_of.begin(), plane_of.begin() + static_cast<std::ptrdiff_t>(p), plane_of[p]) !=
        plane_of.begin() + static_cast<std::ptrdiff_t>(p))
      continue;
    std::vector<const WeldedPiece*> group;
    for (std::size_t q = p; q < plane_of.size(); ++q)
      if (plane_of[q] == plane_of[p]) group.push_back(&welding.pieces[q]);
    PlaneJoining(welding, std::move(group), shell).run();
  }
  drop_straight_corners(shell);
  return shell;
}

OpenBorder open_border(const std::vector<ShellPiece>& pieces, const Eigen::Vector3d& normal) {
  const ShellWelding welding(pieces);
  std::vector<Ring> all;
  for (const auto& piece : welding.pieces) all.insert(all.end(), piece.rings.begin(), piece.rings.end());
  OpenBorder border;
  // Seen from behind the open border runs as an outline does.
  for (const auto& ring : layout::joined_rings(all, welding.vertices, -normal)) {
    std::vector<Eigen::Vector3d> places;
    for (auto v = ring.rbegin(); v != ring.rend(); ++v) places.push_back(welding.vertices[*v]);
    const double area = layout::signed_area(ring, welding.vertices, -normal);
    if (std::abs(area) > least_face) (area > 0 ? border.outlines : border.holes).push_back(std::move(places));
  }
  return border;
}

bool is_closed(const std::vector<BuildingFace>& faces) {
  const Sides sides = sides_of(faces);
  return !sides.empty() && std::all_of(sides.begin(), sides.end(), [&](const auto& side) {
    const auto other = sides.find({side.first.second, side.first.first});
    return other != sides.end() && other->second.size() == side.second.size();
  });
}

std::size_t parts_of(const std::vector<BuildingFace>& faces) {
  const Sides sides = sides_of(faces);
  std::vector<std::vector<std::size_t>> beside(faces.size());
  for (const auto& [side, own] : sides) {
    const auto other = sides.find({side.second, side.first});
    if (other == sides.end()) continue;
    for (const auto f : own) beside[f].insert(beside[f].end(), other->second.begin(), other->second.end());
  }
  std::vector<bool> reached(faces.size(), false);
  std::size_t parts = 0;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (reached[f]) continue;
    ++parts;
    std::vector<std::size_t> open{f};
    reached[f] = true;
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      for (const auto next : beside[at]) {
        if (reached[next]) continue;
        reached[next] = true;
        open.push_back(next);
      }
    }
  }
  return parts;
}

PlanPolygon flat_polygon(const Building& building, const BuildingFace& face) {
  const PlaneFrame frame = upright_frame(face.plane, building.vertices[face.outline[0]]);
  const auto flat = [&](const Ring& ring) {
    PlanRing result;
    for (const auto v : ring) result.push_back(frame.to_plane(building.vertices[v]));
    return result;
  };
  PlanPolygon result{flat(face.outline), {}};
  for (const auto& hole : face.holes) result.holes.push_back(flat(hole));
  return result;
}

}  // namespace atrium::building
