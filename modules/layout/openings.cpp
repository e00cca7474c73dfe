#include "modules/layout/openings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "modules/layout/face_holes.hpp"
#include "modules/layout/raster.hpp"
#include "modules/layout/wall_pairs.hpp"

namespace atrium::layout {
namespace {

using Found = std::vector<std::vector<FaceHole>>;  // per face

/// The hole seen from the opposite face: the same places, moved onto it.
std::vector<Eigen::Vector3d> across(const std::vector<Eigen::Vector3d>& outline, const Plane& plane) {
  std::vector<Eigen::Vector3d> result;
  for (auto it = outline.rbegin(); it != outline.rend(); ++it)
    result.push_back(*it - plane.normal * plane.signed_distance(*it));
  return result;
}

/// Intersection over the smaller of two rectangles, the second seen in the frame of the first.
double shared(const FaceHole& a, const FaceHole& b) {
  Eigen::AlignedBox2d box;
  for (const auto& p : b.outline) box.extend(a.frame.to_plane(p));
  const Eigen::AlignedBox2d both = a.box.intersection(box);
  return both.isEmpty() ? 0 : both.volume() / std::min(a.box.volume(), box.volume());
}

BuildingOpening opening_of(const Building& building, std::size_t face, const FaceHole& hole) {
  BuildingOpening opening;
  opening.kind = hole.kind;
  opening.face_a = static_cast<std::int32_t>(face);
  opening.room_a = building.faces[face].room;
  opening.outline_a = hole.outline;
  return opening;
}

/// Joins the holes of opposite faces.
class Joining {
 public:
  Joining(Building& building, Found& found) : building_(building), found_(found) {
    for (auto& holes : found_) used_.emplace_back(holes.size(), false);
  }

  void run() {
    for (std::size_t f = 0; f < found_.size(); ++f)
      for (std::size_t h = 0; h < found_[f].size(); ++h)
        if (!used_[f][h]) join(f, h);
  }

 private:
  void join(std::size_t f, std::size_t h) {
    used_[f][h] = true;
    FaceHole& hole = found_[f][h];
    BuildingOpening opening = opening_of(building_, f, hole);
    const BuildingWall* best = nullptr;
    std::size_t twin = 0;
    double most = 0;
    for (const auto& wall : building_.walls) {
      if (static_cast<std::size_t>(wall.face_a) != f && static_cast<std::size_t>(wall.face_b) != f) continue;
      const auto other =
          static_cast<std::size_t>(static_cast<std::size_t>(wall.face_a) == f ? wall.face_b : wall.face_a);
      for (std::size_t k = 0; k < found_[other].size(); ++k) {
        if (used_[other][k]) continue;
        const double share = shared(hole, found_[other][k]);
        if (share <= most) continue;
        most = share;
        best = &wall;
        twin = k;
      }
    }
    constexpr double enough = 0.5;
    if (best != nullptr && most > enough) {
      const auto other =
          static_cast<std::size_t>(static_cast<std::size_t>(best->face_a) == f ? best->face_b : best->face_a);
      used_[other][twin] = true;
      const FaceHole& back = found_[other][twin];
      opening.face_b = static_cast<std::int32_t>(other);
      opening.room_b = building_.faces[other].room;
      opening.thickness = std::abs(building_.faces[other].plane.signed_distance(hole.outline[0]));
      opening.outline_b = back.outline;
      if (back.kind == "door") opening.kind = "door";
    } else {
      pierce_unseen(hole, f, opening);
    }
    building_.openings.push_back(std::move(opening));
  }

  /// The face behind, where it stands over the whole hole.
  void pierce_unseen(const FaceHole& hole, std::size_t f, BuildingOpening& opening) const {
    for (const auto& wall : building_.walls) {
      if (static_cast<std::size_t>(wall.face_a) != f && static_cast<std::size_t>(wall.face_b) != f) continue;
      const auto other =
          static_cast<std::size_t>(static_cast<std::size_t>(wall.face_a) == f ? wall.face_b : wall.face_a);
      const BuildingFace& face = building_.faces[other];
      const auto outline = across(hole.outline, face.plane);
      const bool whole = std::all_of(outline.begin(), outline.end(),
                                     [&](const Eigen::Vector3d& p) { return face_contains(building_, face, p, 0.02); });
      if (!whole) continue;
      opening.face_b = static_cast<std::int32_t>(other);
      opening.room_b = face.room;
      opening.thickness = std::abs(face.plane.signed_distance(hole.outline[0]));
      opening.outline_b = outline;
      return;
    }
  }

  Building& building_;
  Found& found_;
  std::vector<std::vector<bool>> used_;
};

}  // namespace

Openings::Out Openings::run(const In& in, const Params& params, Context& context) {
  Out out{*in.building};
  Building& building = out.building;
  building.openings.clear();
  building.walls = wall_pairs(building, params.max_thickness);
  const PlanePrimitives& planes = *in.structure->primitives;
  const double pixel = fitting_pixel(planes, params.pixel, context);
  HoleFinder finder(building, *planes.cloud, params, pixel);
  Found found(building.faces.size());
  context.parallel_for(
      found.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) found[f] = finder.holes(f);
      },
      1);
  Joining(building, found).run();
  const auto count = [&](std::string_view kind) {
    return std::count_if(building.openings.begin(), building.openings.end(),
                         [&](const auto& opening) { return opening.kind == kind; });
  };
  context.info(fmt::format("{} doors, {} windows, {} slab openings; {} walls seen from both sides", count("door"),
                           count("window"), count("slab"), building.walls.size()));
  return out;
}

}  // namespace atrium::layout
