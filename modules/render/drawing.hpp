#pragma once
#include <Eigen/Geometry>
#include <memory>
#include <utility>
#include <vector>

#include "modules/types/adjacency.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/mesh.hpp"
#include "modules/types/plane_meshes.hpp"

class vtkRenderer;

namespace atrium::render {

/// What is to be seen, in one frame: z up, coordinates relative to `origin`.
class Drawing {
 public:
  Drawing(const Transform& to_upright, const Eigen::Vector3d& background);
  ~Drawing();
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;

  struct CloudStyle {
    double point_size = 2;             ///< pixels
    std::size_t max_points = 2000000;  ///< more are thinned evenly, for drawing only
    double cut_below_top = 0;          ///< metres at the top that are left out (the ceiling); 0: none
  };
  /// Points in the given colours (one per point).
  void add_cloud(const Cloud& cloud, const std::vector<Colour>& colours, const CloudStyle& style);

  struct MeshStyle {
    bool edges = true;     ///< the outlines of faces
    bool inside = true;    ///< only sides that face the camera: rooms are looked into from outside
    bool ceilings = true;  ///< draw faces of the class ceiling
    bool vertex_colours = false;
  };
  void add_mesh(const Mesh& mesh, const MeshStyle& style);

  /// Lines from mesh centre to mesh centre.
  void add_adjacency(const PlaneMeshes& meshes, const Adjacency& adjacency);

  /// The box that a camera must show: meshes whole, clouds without their outermost 0.1 % on each side.
  Eigen::AlignedBox3d bounds() const;
  bool empty() const;
  vtkRenderer* renderer() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The outlines of a mesh's faces: edges of one triangle only, or between triangles of different primitives. Pairs of
/// vertices.
std::vector<std::pair<std::uint32_t, std::uint32_t>> outline_edges(const Mesh& mesh);

}  // namespace atrium::render
