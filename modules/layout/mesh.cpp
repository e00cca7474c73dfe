#include "modules/layout/mesh.hpp"

#include <Eigen/Geometry>
#include <map>

#include "modules/geometry/ear_clipping.hpp"
#include "modules/geometry/plan_overlay.hpp"
#include "modules/geometry/plane_frame.hpp"
#include "modules/types/palette.hpp"

namespace atrium::layout {
namespace {

/// A mesh that grows face by face.
class Surface {
 public:
  explicit Surface(const Building& building, bool colours) : colours_(colours) { mesh_.origin = building.origin; }

  std::uint32_t vertex(const Eigen::Vector3d& place, SurfaceClass surface) {
    mesh_.vertices.push_back(place);
    if (colours_) mesh_.colours.push_back(class_colour(surface));
    return static_cast<std::uint32_t>(mesh_.vertices.size()) - 1;
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, SurfaceClass surface, std::int32_t storey,
                std::size_t face) {
    mesh_.triangles.push_back({a, b, c});
    mesh_.classes.push_back(surface);
    mesh_.storeys.push_back(storey);
    mesh_.primitives.push_back(static_cast<std::int32_t>(face));
  }
  atrium::Mesh take(const Transform* transform) {
    return transform != nullptr ? transformed(mesh_, inverse(*transform)) : std::move(mesh_);
  }

 private:
  atrium::Mesh mesh_;
  bool colours_;
};

class Meshing {
 public:
  Meshing(const Building& building, bool colours)
      : building_(building), shell_(building, colours), structure_(building, colours), openings_(building, colours) {}

  Mesh::Out run(const Transform* transform) {
    for (std::size_t f = 0; f < building_.faces.size(); ++f) add_face(f);
    return {shell_.take(transform), structure_.take(transform), openings_.take(transform)};
  }

 private:
  void add_face(std::size_t f) {
    const BuildingFace& face = building_.faces[f];
    const PlaneFrame frame = upright_frame(face.plane, building_.vertices[face.outline[0]]);
    std::vector<std::uint32_t> corners = face.outline;
    PlanPolygon polygon;
    polygon.outline = flat(face.outline, frame);
    for (const auto& hole : face.holes) {
      corners.insert(corners.end(), hole.begin(), hole.end());
      polygon.holes.push_back(flat(hole, frame));
    }
    std::vector<std::uint32_t> vertices;
    vertices.reserve(corners.size());
    for (const auto c : corners) vertices.push_back(shell_vertex(c, face.surface));
    for (const auto& t : clip_ears(polygon))
      shell_.triangle(vertices[t[0]], vertices[t[1]], vertices[t[2]], face.surface, face.storey, f);
    std::vector<PlanRing> cuts;
    for (const auto& opening : building_.openings) {
      if (opening.face_a == static_cast<std::int32_t>(f)) cuts.push_back(flat(opening.outline_a, frame));
      if (opening.face_b == static_cast<std::int32_t>(f)) cuts.push_back(flat(opening.outline_b, frame));
    }
    cut_out(f, frame, polygon, cuts);
  }

  /// One vertex for each corner, so that rooms stay closed: it has the colour of the first face that uses it.
  std::uint32_t shell_vertex(std::uint32_t corner, SurfaceClass surface) {
    const auto [it, is_new] = shell_vertices_.emplace(corner, 0U);
    if (is_new) it->second = shell_.vertex(building_.vertices[corner], surface);
    return it->second;
  }

  PlanRing flat(const std::vector<std::uint32_t>& ring, const PlaneFrame& frame) const {
    PlanRing result;
    result.reserve(ring.size());
    for (const auto i : ring) result.push_back(frame.to_plane(building_.vertices[i]));
    return result;
  }
  static PlanRing flat(const std::vector<Eigen::Vector3d>& ring, const PlaneFrame& frame) {
    PlanRing result;
    result.reserve(ring.size());
    for (const auto& p : ring) result.push_back(frame.to_plane(p));
    return result;
  }

  void cut_out(std::size_t f, const PlaneFrame& frame, const PlanPolygon& polygon, const std::vector<PlanRing>& cuts) {
    if (cuts.empty()) {
      add_polygon(structure_, f, frame, polygon, building_.faces[f].surface);
      return;
    }
    std::vector<PlanPolygon> rest{polygon}, panes;
    for (const auto& cut : cuts) {
      const PlanPolygon hole = overlay::corrected({cut, {}});
      const auto pane = overlay::intersection(rest, hole);
      rest = overlay::difference(rest, hole);
      panes.insert(panes.end(), pane.begin(), pane.end());
    }
    for (const auto& part : rest) add_polygon(structure_, f, frame, part, building_.faces[f].surface);
    for (const auto& part : panes) add_polygon(openings_, f, frame, part, SurfaceClass::object);
  }

  void add_polygon(Surface& surface, std::size_t f, const PlaneFrame& frame, const PlanPolygon& polygon,
                   SurfaceClass kind) const {
    std::vector<std::uint32_t> vertices;
    const auto add = [&](const PlanRing& ring) {
      for (const auto& p : ring) vertices.push_back(surface.vertex(frame.to_space(p), kind));
    };
    add(polygon.outline);
    for (const auto& hole : polygon.holes) add(hole);
    for (const auto& t : clip_ears(polygon))
      surface.triangle(vertices[t[0]], vertices[t[1]], vertices[t[2]], kind, building_.faces[f].storey, f);
  }

  const Building& building_;
  Surface shell_, structure_, openings_;
  std::map<std::uint32_t, std::uint32_t> shell_vertices_;
};

}  // namespace

Mesh::Out Mesh::run(const In& in, const Params& params) {
  return Meshing(*in.building, params.class_colours).run(in.transform.get());
}

}  // namespace atrium::layout
