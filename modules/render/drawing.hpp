#pragma once
#include <Eigen/Geometry>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "modules/types/adjacency.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/mesh.hpp"
#include "modules/types/plane_meshes.hpp"
#include "modules/types/textures.hpp"

class vtkRenderer;

namespace atrium::render {

/// What is to be seen, in one frame: z up, coordinates relative to the origin of what is added first.
class Drawing {
 public:
  Drawing(const Transform& to_upright, const Eigen::Vector3d& background);
  ~Drawing();
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;

  /// The chosen points, in the given colours (one per chosen point), but for those nearer than `cut_below_top` metres
  /// to the top (the ceiling); 0: all of them.
  void add_points(const Cloud& cloud, const std::vector<std::uint32_t>& chosen, const std::vector<Colour>& colours,
                  double cut_below_top);
  /// Pixels; 0: so that points close up to surfaces where they are not too sparse for it; lone points are small.
  void set_point_size(double pixels, double metres_per_pixel, int picture_height);

  struct MeshStyle {
    double line_width = 1;  ///< pixels
    bool edges = true;      ///< the outlines of faces
    bool inside = true;     ///< only sides that face the camera: rooms are looked into from outside
    bool ceilings = true;   ///< draw faces of the class ceiling
    bool vertex_colours = false;
  };
  /// Faces of primitives that have an image are drawn with it, the others in the colour of their class.
  void add_mesh(const Mesh& mesh, const MeshStyle& style, const Textures* textures = nullptr);

  /// Lines from mesh centre to mesh centre.
  void add_adjacency(const PlaneMeshes& meshes, const Adjacency& adjacency);

  /// The box that a camera must show: meshes whole, clouds without their outermost 0.1 % on each side.
  Eigen::AlignedBox3d bounds() const;
  bool empty() const;
  /// The classes of surfaces that are drawn in their class's colour; none from meshes without classes.
  const std::set<SurfaceClass>& classes() const;
  /// Points on all that is drawn: those of clouds, and of triangles a few centimetres apart; some hundred thousand.
  std::vector<Eigen::Vector3f> surface_points() const;
  /// From a place in the upright frame to the drawing's coordinates.
  Eigen::Vector3d local(const Eigen::Vector3d& upright) const;
  vtkRenderer* renderer() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The outlines of a mesh's faces: edges of one triangle only, or between triangles of different primitives. Pairs of
/// vertices.
std::vector<std::pair<std::uint32_t, std::uint32_t>> outline_edges(const Mesh& mesh);

}  // namespace atrium::render
