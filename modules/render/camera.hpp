#pragma once
#include <Eigen/Geometry>
#include <vector>

class vtkRenderer;

namespace atrium::render {

enum class View { isometric, top, front, back, left, right, inside };

/// How a named view fills the picture.
struct Frame {
  int width = 0, height = 0;  ///< pixels
  int right_margin = 0;       ///< pixels that stay free
  bool perspective = false;
  double field_of_view = 30;  ///< of a perspective view, degrees from top to bottom
  double view_width = 0;      ///< metres from the left to the right, at the middle of the box; 0: so that the box fits
};

/// Points the renderer's camera at the box (z up), so that all of it is seen left of a margin (pixels). Front looks
/// along +y, left along +x; isometric from the south-west and above. Not for View::inside. Returns the metres that a
/// pixel shows at the middle of the box.
double set_view(vtkRenderer* renderer, View view, const Eigen::AlignedBox3d& box, const Frame& frame);

/// A perspective camera at an eye that looks at a target. Metres, relative to the drawing's origin; the field of view
/// is from top to bottom, degrees. Returns the metres that a pixel shows three metres away.
double set_view(vtkRenderer* renderer, const Eigen::Vector3d& eye, const Eigen::Vector3d& target, double field_of_view,
                int height);

/// Where a camera that looks along a direction (not zero) stands so that it sees all of the box: the box's middle is in
/// the picture's, the box as large as it can be but for a small margin.
Eigen::Vector3d fitted_eye(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& direction, double field_of_view,
                           int width, int height);

/// Makes what the renderer's parallel or perspective camera shows smaller, to 70 % at most, until none of the points
/// lies under one of the plates (pixels from the lower left corner). Returns by how much: 1 where nothing is hidden.
double make_room(vtkRenderer* renderer, const std::vector<Eigen::Vector3f>& points,
                 const std::vector<Eigen::AlignedBox2d>& plates, int width, int height);

}  // namespace atrium::render
