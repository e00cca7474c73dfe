#include "modules/layout/room_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "modules/layout/face_rings.hpp"
#include "modules/layout/room_cells.hpp"

namespace atrium::layout {
namespace {

constexpr double straight = 1.5e-3;  // corners nearer to the line of their neighbours are none

class Builder {
 public:
  Builder(const StoreyCells& storey, std::int32_t room) : storey_(storey), room_(room) {}

  RoomSurface run() {
    for (std::size_t i = 0; i < storey_.cells.size(); ++i)
      if (is_inside(static_cast<std::int32_t>(i))) gather_heights(storey_.cells[i]);
    for (auto& [vertex, heights] : heights_) settle(vertex, heights);
    for (std::size_t i = 0; i < storey_.cells.size(); ++i)
      if (is_inside(static_cast<std::int32_t>(i))) add_levels(storey_.cells[i]);
    for (const auto& edge : storey_.edges) {
      add_side(edge, edge.from, edge.to, edge.left, edge.right);
      add_side(edge, edge.to, edge.from, edge.right, edge.left);
    }
    join_faces();
    set_outline();
    drop_straight_corners();
    drop_unused_vertices();
    return std::move(surface_);
  }

 private:
  struct Height {
    double z;
    std::uint32_t id;
  };

  bool is_inside(std::int32_t cell) const {
    return cell >= 0 && storey_.cells[static_cast<std::size_t>(cell)].room == room_;
  }

  void gather_heights(const LayoutCell& cell) {
    for (const auto c : cell.corners) {
      auto& heights = heights_[c];
      heights.push_back({floor_at(storey_, cell, storey_.vertices[c]), 0});
      heights.push_back({ceiling_at(storey_, cell, storey_.vertices[c]), 0});
    }
  }

  /// Sorts the heights over a vertex; those that are one get one vertex of the surface.
  void settle(std::uint32_t vertex, std::vector<Height>& heights) {
    std::sort(heights.begin(), heights.end(), [](const auto& a, const auto& b) { return a.z < b.z; });
    std::vector<Height> distinct;
    for (const auto& h : heights) {
      if (!distinct.empty() && h.z - distinct.back().z <= one_height) continue;
      const Eigen::Vector2d& p = storey_.vertices[vertex];
      distinct.push_back({h.z, static_cast<std::uint32_t>(surface_.vertices.size())});
      surface_.vertices.emplace_back(p.x(), p.y(), h.z);
    }
    heights = std::move(distinct);
  }

  /// Position in the heights over a vertex.
  std::size_t place(std::uint32_t vertex, double z) const {
    const auto& heights = heights_.at(vertex);
    std::size_t best = 0;
    for (std::size_t i = 1; i < heights.size(); ++i)
      if (heights[i].z <= z + 1e-12) best = i;
    return best;
  }
  std::uint32_t id(std::uint32_t vertex, double z) const { return heights_.at(vertex)[place(vertex, z)].id; }

  void add_levels(const LayoutCell& cell) {
    Ring floor, ceiling;
    for (const auto c : cell.corners) {
      floor.push_back(id(c, floor_at(storey_, cell, storey_.vertices[c])));
      ceiling.push_back(id(c, ceiling_at(storey_, cell, storey_.vertices[c])));
    }
    std::reverse(ceiling.begin(), ceiling.end());
    pieces_[{SurfaceClass::floor, cell.floor, true}].push_back(std::move(floor));
    pieces_[{SurfaceClass::ceiling, cell.ceiling, true}].push_back(std::move(ceiling));
  }

  /// What stands over the edge a → b before the cell to its left.
  void add_side(const CellEdge& edge, std::uint32_t a, std::uint32_t b, std::int32_t left, std::int32_t right) {
    if (!is_inside(left)) return;
    const Eigen::Vector2d& p = storey_.vertices[a];
    const Eigen::Vector2d& q = storey_.vertices[b];
    const LayoutCell& here = storey_.cells[static_cast<std::size_t>(left)];
    FaceKey key{SurfaceClass::wall, edge.line, true};
    if (edge.line >= 0)
      key.along_normal = storey_.lines[static_cast<std::size_t>(edge.line)].normal.dot(
                             Eigen::Vector2d(p.y() - q.y(), q.x() - p.x())) > 0;
    const double floor_p = floor_at(storey_, here, p), floor_q = floor_at(storey_, here, q);
    const double ceiling_p = ceiling_at(storey_, here, p), ceiling_q = ceiling_at(storey_, here, q);
    if (!is_inside(right)) {
      add_piece(key, a, b, floor_p, floor_q, ceiling_p, ceiling_q);
      return;
    }
    const LayoutCell& there = storey_.cells[static_cast<std::size_t>(right)];
    add_piece(key, a, b, floor_p, floor_q, floor_at(storey_, there, p), floor_at(storey_, there, q));
    add_piece(key, a, b, ceiling_at(storey_, there, p), ceiling_at(storey_, there, q), ceiling_p, ceiling_q);
  }

  /// The upright polygon over a → b that looks to the left, if its top is above its bottom.
  void add_piece(const FaceKey& key, std::uint32_t a, std::uint32_t b, double bottom_a, double bottom_b, double top_a,
                 double top_b) {
    const std::size_t low_a = place(a, bottom_a), high_a = place(a, top_a);
    const std::size_t low_b = place(b, bottom_b), high_b = place(b, top_b);
    if (high_a < low_a || high_b < low_b || (high_a == low_a && high_b == low_b)) return;
    Ring ring;
    for (std::size_t i = low_a; i <= high_a; ++i) ring.push_back(heights_.at(a)[i].id);
    for (std::size_t i = high_b + 1; i-- > low_b;) ring.push_back(heights_.at(b)[i].id);
    pieces_[key].push_back(std::move(ring));
  }

  Eigen::Vector3d normal_of(const FaceKey& key) const {
    const auto index = static_cast<std::size_t>(std::max(key.index, 0));
    if (key.surface == SurfaceClass::floor || key.surface == SurfaceClass::ceiling) {
      const Eigen::Vector3d& n =
          (key.surface == SurfaceClass::floor ? storey_.floors : storey_.ceilings)[index].plane.normal;
      return (n.z() > 0) == (key.surface == SurfaceClass::floor) ? n : Eigen::Vector3d(-n);
    }
    const Eigen::Vector2d n = key.index < 0 ? Eigen::Vector2d::UnitX() : storey_.lines[index].normal;
    return (key.along_normal ? 1.0 : -1.0) * Eigen::Vector3d(n.x(), n.y(), 0);
  }

  void join_faces() {
    for (const auto& [key, polygons] : pieces_) {
      const Eigen::Vector3d normal = normal_of(key);
      std::vector<Ring> holes;
      const std::size_t first = surface_.faces.size();
      for (auto& ring : joined_rings(polygons, surface_.vertices, normal)) {
        if (signed_area(ring, surface_.vertices, normal) > 0)
          surface_.faces.push_back({key, std::move(ring), {}});
        else
          holes.push_back(std::move(ring));
      }
      for (auto& hole : holes) {
        RoomFace* best = nullptr;
        double least = 0;
        for (std::size_t f = first; f < surface_.faces.size(); ++f) {
          RoomFace& face = surface_.faces[f];
          const double area = signed_area(face.outline, surface_.vertices, normal);
          const Eigen::Vector3d inside = (surface_.vertices[hole[0]] + surface_.vertices[hole[1]]) / 2;
          if (!ring_contains(face.outline, surface_.vertices, normal, inside) || (best != nullptr && area >= least))
            continue;
          best = &face;
          least = area;
        }
        if (best != nullptr) best->holes.push_back(std::move(hole));
      }
    }
  }

  void set_outline() {
    std::vector<Ring> cells;
    for (const auto& cell : storey_.cells)
      if (cell.room == room_) cells.push_back(cell.corners);
    std::vector<Eigen::Vector3d> places;
    for (const auto& v : storey_.vertices) places.emplace_back(v.x(), v.y(), 0);
    double most = 0;
    for (const auto& ring : joined_rings(cells, places, Eigen::Vector3d::UnitZ())) {
      const std::vector<bool> dropped = straight_corners({&ring}, places, straight);
      std::vector<Eigen::Vector2d> outline;
      for (const auto v : ring)
        if (!dropped[v]) outline.push_back(storey_.vertices[v]);
      const double area = signed_area(ring, places, Eigen::Vector3d::UnitZ());
      if (area < 0) {
        surface_.holes.push_back(std::move(outline));
      } else if (area > most) {
        most = area;
        surface_.outline = std::move(outline);
      }
    }
  }

  template <class Visit>
  void each_ring(Visit visit) {
    for (auto& face : surface_.faces) {
      visit(face.outline);
      for (auto& hole : face.holes) visit(hole);
    }
  }

  void drop_straight_corners() {
    std::vector<const Ring*> rings;
    each_ring([&](const Ring& ring) { rings.push_back(&ring); });
    const std::vector<bool> dropped = straight_corners(rings, surface_.vertices, straight);
    each_ring([&](Ring& ring) { std::erase_if(ring, [&](std::uint32_t v) { return dropped[v]; }); });
    const auto gone = [](const Ring& ring) { return ring.size() < 3; };
    for (auto& face : surface_.faces) std::erase_if(face.holes, gone);
    std::erase_if(surface_.faces, [&](const RoomFace& face) { return gone(face.outline); });
  }

  void drop_unused_vertices() {
    constexpr std::uint32_t unused = 0xffffffffU;
    std::vector<std::uint32_t> place(surface_.vertices.size(), unused);
    std::vector<Eigen::Vector3d> vertices;
    each_ring([&](Ring& ring) {
      for (auto& v : ring) {
        if (place[v] == unused) {
          place[v] = static_cast<std::uint32_t>(vertices.size());
          vertices.push_back(surface_.vertices[v]);
        }
        v = place[v];
      }
    });
    surface_.vertices = std::move(vertices);
  }

  const StoreyCells& storey_;
  std::int32_t room_;
  std::map<std::uint32_t, std::vector<Height>> heights_;  // over the vertices of the storey
  std::map<FaceKey, std::vector<Ring>> pieces_;
  RoomSurface surface_;
};

}  // namespace

RoomSurface room_surface(const StoreyCells& storey, std::int32_t room) { return Builder(storey, room).run(); }

}  // namespace atrium::layout
