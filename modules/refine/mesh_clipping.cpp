#include "modules/refine/mesh_clipping.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "modules/geometry/plane_frame.hpp"
#include "modules/geometry/polygon.hpp"
#include "modules/refine/check.hpp"

namespace atrium::refine {
namespace {

constexpr double on_line = 1e-6;  // metres: a cut makes no sliver thinner than this

/// A part of a floor or ceiling and the points in it, in the coordinates of its plane.
struct Piece {
  Polygon2 outline;
  std::vector<Eigen::Vector2f> points;
};

/// Where a wall's plane cuts the frame's plane; the normal is of unit length, or zero if the planes are parallel.
Line2 trace_of(const Plane& wall, const PlaneFrame& frame) {
  Line2 line{{wall.normal.dot(frame.u), wall.normal.dot(frame.v)}, wall.signed_distance(frame.origin)};
  const double length = line.normal.norm();
  constexpr double parallel = 1e-9;
  if (length < parallel) return {Eigen::Vector2d::Zero(), 1.0};
  return {line.normal / length, line.offset / length};
}

/// Splits a piece's points; cost is one pass over them.
void split(std::vector<Eigen::Vector2f>& points, const Line2& line, Piece& positive, Piece& negative) {
  const Eigen::Vector2f normal = line.normal.cast<float>();
  const auto offset = static_cast<float>(line.offset);
  const auto middle = std::partition(points.begin(), points.end(),
                                     [&](const Eigen::Vector2f& p) { return normal.dot(p) + offset >= 0; });
  negative.points.assign(middle, points.end());
  points.erase(middle, points.end());
  positive.points = std::move(points);
}

std::vector<Piece> clip(std::vector<Piece> pieces, const Line2& line, std::size_t min_points) {
  std::vector<Piece> kept;
  const auto keep = [&](Piece&& piece) {
    if (piece.points.size() > min_points) kept.push_back(std::move(piece));
  };
  for (auto& piece : pieces) {
    CutPolygon parts = cut(piece.outline, line, on_line);
    if (parts.positive.empty() || parts.negative.empty()) {
      keep(std::move(piece));
      continue;
    }
    Piece positive{std::move(parts.positive), {}};
    Piece negative{std::move(parts.negative), {}};
    split(piece.points, line, positive, negative);
    keep(std::move(positive));
    keep(std::move(negative));
  }
  return kept;
}

/// The mesh as one piece, with the points of its primitive that lie in it.
Piece whole(const PlaneMesh& mesh, const PlaneFrame& frame, const PlanePrimitives& planes) {
  Piece piece;
  for (const auto& corner : mesh.corners) piece.outline.push_back(frame.to_plane(corner));
  std::vector<Line2> sides;  // inside is positive
  for (std::size_t i = 0; i < piece.outline.size(); ++i) {
    const Eigen::Vector2d edge = (piece.outline[(i + 1) % piece.outline.size()] - piece.outline[i]).normalized();
    const Eigen::Vector2d inwards(-edge.y(), edge.x());
    sides.push_back({inwards, -inwards.dot(piece.outline[i])});
  }
  constexpr double rounding = 1e-4;  // metres: the rim is through the outermost points
  const auto& inliers = planes.primitives[static_cast<std::size_t>(mesh.primitive)].inliers;
  piece.points.reserve(inliers.size());
  for (const auto i : inliers) {
    const Eigen::Vector2d p = frame.to_plane(planes.cloud->points[i].cast<double>());
    if (std::all_of(sides.begin(), sides.end(), [&](const Line2& side) { return side.side(p) >= -rounding; }))
      piece.points.emplace_back(p.cast<float>());
  }
  return piece;
}

std::vector<PlaneMesh> clipped(std::size_t index, const MeshClipping::In& in, std::size_t min_points) {
  const auto& meshes = in.meshes->meshes;
  const PlaneMesh& mesh = meshes[index];
  std::vector<std::size_t> walls = in.adjacency->neighbours(index);
  std::erase_if(walls, [&](std::size_t j) { return meshes[j].surface != SurfaceClass::wall; });
  if (walls.empty()) return {mesh};
  const PlaneFrame frame = upright_frame(mesh.plane, mesh.corners.front());
  std::vector<Piece> pieces{whole(mesh, frame, *in.structure->primitives)};
  for (const std::size_t j : walls) pieces = clip(std::move(pieces), trace_of(meshes[j].plane, frame), min_points);
  std::vector<PlaneMesh> result;
  for (const auto& piece : pieces) {
    PlaneMesh part = mesh;
    part.corners.clear();
    for (const auto& corner : piece.outline) part.corners.push_back(frame.to_space(corner));
    result.push_back(std::move(part));
  }
  return result;
}

void check_primitives(const MeshClipping::In& in) {
  const std::size_t primitives = in.structure->primitives->primitives.size();
  for (const auto& mesh : in.meshes->meshes)
    if (mesh.primitive < 0 || static_cast<std::size_t>(mesh.primitive) >= primitives)
      throw Error(fmt::format("a mesh names primitive {}, but the structure has {}", mesh.primitive, primitives),
                  "wire the structure that the meshes were made from");
}

}  // namespace

MeshClipping::Out MeshClipping::run(const In& in, const Params& params, Context& context) {
  check_matches(*in.adjacency, *in.meshes);
  check_primitives(in);
  const auto& meshes = in.meshes->meshes;
  std::vector<std::vector<PlaneMesh>> pieces(meshes.size());
  context.parallel_for(
      meshes.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          if (meshes[i].surface != SurfaceClass::wall)
            pieces[i] = clipped(i, in, static_cast<std::size_t>(params.min_points));
      },
      1);
  Out out;
  out.meshes.origin = in.meshes->origin;
  for (const auto& mesh : meshes)
    if (mesh.surface == SurfaceClass::wall) out.meshes.meshes.push_back(mesh);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    if (meshes[i].surface == SurfaceClass::wall) continue;
    if (pieces[i].empty())
      context.warn(fmt::format("nothing is left of the {} of primitive {}: no part has more than {} points",
                               name_of(meshes[i].surface), meshes[i].primitive, params.min_points));
    for (auto& piece : pieces[i]) out.meshes.meshes.push_back(std::move(piece));
  }
  return out;
}

}  // namespace atrium::refine
