#include "modules/layout/mirror_images.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace atrium::layout {
namespace {

constexpr double cell = 0.1;       // metres: how near an image must be
constexpr double off_faces = 0.2;  // metres: radiators and skirting boards stand in any room

std::uint64_t key_of(const Eigen::Vector3d& p) {
  std::uint64_t key = 0;
  for (int k = 0; k < 3; ++k)
    key = key << 21U | (static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(p[k] / cell))) & 0x1fffffU);
  return key;
}

bool contains(const std::vector<Eigen::Vector3d>& ring, const Eigen::Vector3d& p) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector3d &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y())) inside = !inside;
  }
  return inside;
}

/// What a room shows.
struct Content {
  Eigen::AlignedBox3d box;
  std::size_t points = 0;                   ///< in all
  std::vector<Eigen::Vector3d> objects;     ///< those off its faces
  std::unordered_set<std::uint64_t> cells;  ///< of the objects

  bool near(const Eigen::Vector3d& p) const {
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z)
          if (cells.count(key_of(p + cell * Eigen::Vector3d(x, y, z))) > 0) return true;
    return false;
  }
};

bool is_at_face(const Building& building, const BuildingRoom& room, const Eigen::Vector3d& p) {
  return std::any_of(room.faces.begin(), room.faces.end(), [&](std::int32_t f) {
    return std::abs(building.faces[static_cast<std::size_t>(f)].plane.signed_distance(p)) < off_faces;
  });
}

std::vector<Content> contents_of(const Building& building, const Cloud& cloud) {
  constexpr std::size_t most = 400000;
  std::vector<Content> result(building.rooms.size());
  for (std::size_t r = 0; r < result.size(); ++r)
    for (const auto f : building.rooms[r].faces)
      for (const auto v : building.faces[static_cast<std::size_t>(f)].outline)
        result[r].box.extend(building.vertices[v]);
  const std::size_t step = std::max<std::size_t>(1, (cloud.size() + most - 1) / most);
  for (std::size_t i = 0; i < cloud.size(); i += step) {
    const Eigen::Vector3d p = cloud.points[i].cast<double>();
    for (std::size_t r = 0; r < result.size(); ++r) {
      const BuildingRoom& room = building.rooms[r];
      if (!result[r].box.contains(p) || !contains(room.outline, p)) continue;
      ++result[r].points;
      if (is_at_face(building, room, p)) break;
      result[r].objects.push_back(p);
      result[r].cells.insert(key_of(p));
      break;
    }
  }
  return result;
}

double share_shown(const Content& shown, const Content& by, const Plane& mirror, const Eigen::Vector3d& moved) {
  const auto count = std::count_if(shown.objects.begin(), shown.objects.end(), [&](const Eigen::Vector3d& p) {
    return by.near(p - 2 * mirror.signed_distance(p) * mirror.normal + moved);
  });
  return static_cast<double>(count) / static_cast<double>(shown.objects.size());
}

/// By how much more of a room's objects stand in the other one mirrored than half a metre beside that along the wall:
/// strays and piles of things are everywhere.
double surplus(const Content& shown, const Content& by, const Plane& mirror, double share) {
  constexpr double aside = 0.5;
  const Eigen::Vector3d along = aside * mirror.normal.cross(Eigen::Vector3d::UnitZ()).normalized();
  return share - std::max(share_shown(shown, by, mirror, along), share_shown(shown, by, mirror, -along));
}

/// Share of a room's objects that stand in the same cells as the other's do, mirrored.
double share_in_cells(const Content& shown, const Content& by, const Plane& mirror) {
  const auto count = std::count_if(shown.objects.begin(), shown.objects.end(), [&](const Eigen::Vector3d& p) {
    return by.cells.count(key_of(p - 2 * mirror.signed_distance(p) * mirror.normal)) > 0;
  });
  return static_cast<double>(count) / static_cast<double>(shown.objects.size());
}

/// How thick the wall is between a face and the other room, as that one's own face tells, metres; 0: it has none there.
double thickness_between(const Building& building, const Plane& face, const BuildingRoom& other) {
  constexpr double thickest = 0.8, least_cosine = 0.98;
  double least = thickest;
  for (const auto f : other.faces) {
    const BuildingFace& behind = building.faces[static_cast<std::size_t>(f)];
    if (behind.plane.normal.dot(face.normal) > -least_cosine || behind.outline.empty()) continue;
    const double off = -face.signed_distance(building.vertices[behind.outline.front()]);
    if (off > 0) least = std::min(least, off);
  }
  return least < thickest ? least : 0;
}

/// Whether the rooms are each other's image at the middle of the wall between them rather than at its face: twins, as
/// dwellings and hotel rooms are. A mirror hangs on the face.
bool are_twins(const Building& building, const Plane& face, const Content& content, const BuildingRoom& other,
               const Content& image) {
  constexpr double least = 0.06;  // metres: a thinner wall tells nothing
  constexpr double much = 0.6;    // of what shows at the face: rows of desks are alike in more places than one
  const double thickness = thickness_between(building, face, other);
  if (thickness < least) return false;
  const Plane middle{face.normal, face.offset + thickness / 2};
  return share_in_cells(image, content, middle) > much * share_in_cells(image, content, face);
}

/// The share of one room's objects that stand in the other one, too, mirrored at the best of its walls.
double mirrored_share(const Building& building, const BuildingRoom& room, const Content& content,
                      const BuildingRoom& other, const Content& image) {
  constexpr double off = 0.75;        // metres between the middles: an image is often cut off
  constexpr double back = 0.5;        // of the room's own objects that its image must show
  constexpr double by_chance = 0.25;  // least surplus
  double best = 0;
  for (const auto f : room.faces) {
    const BuildingFace& face = building.faces[static_cast<std::size_t>(f)];
    if (face.surface != SurfaceClass::wall) continue;
    const Plane& mirror = face.plane;
    const Eigen::Vector3d middle = image.box.center();
    const Eigen::Vector3d mirrored = middle - 2 * mirror.signed_distance(middle) * mirror.normal;
    if ((mirrored - content.box.center()).norm() > off) continue;
    if (share_shown(content, image, mirror, Eigen::Vector3d::Zero()) < back) continue;
    const double share = share_shown(image, content, mirror, Eigen::Vector3d::Zero());
    if (share > best && surplus(image, content, mirror, share) > by_chance &&
        !are_twins(building, mirror, content, other, image))
      best = share;
  }
  return best;
}

}  // namespace

std::vector<MirrorImage> mirror_images(const Building& building, const PlanePrimitives& planes) {
  constexpr std::size_t fewest = 300;
  constexpr double least = 0.7;
  std::vector<MirrorImage> result;
  if (building.rooms.size() < 2) return result;
  const std::vector<Content> contents = contents_of(building, *planes.cloud);
  for (std::size_t image = 0; image < contents.size(); ++image) {
    if (contents[image].objects.size() < fewest) continue;
    for (std::size_t room = 0; room < contents.size(); ++room) {
      if (contents[room].points <= contents[image].points || contents[room].objects.size() < fewest) continue;
      const double share =
          mirrored_share(building, building.rooms[room], contents[room], building.rooms[image], contents[image]);
      if (share < least) continue;
      result.push_back({image, room, share});
      break;
    }
  }
  return result;
}

}  // namespace atrium::layout
