#pragma once
#include <Eigen/Geometry>

class vtkRenderer;

namespace atrium::render {

enum class View { isometric, top, front, back, left, right, inside };

/// Points the renderer's camera at the box (z up), so that all of it is seen left of a margin (pixels). Front looks
/// along +y, left along +x; isometric from the south-west and above. Not for View::inside. Returns the metres that a
/// pixel shows at the middle of the box.
double set_view(vtkRenderer* renderer, View view, const Eigen::AlignedBox3d& box, int width, int height,
                int right_margin, bool perspective);

/// A perspective camera at an eye that looks at a target: 62 degrees from top to bottom. Metres, relative to the
/// drawing's origin. Returns the metres that a pixel shows three metres away.
double set_view(vtkRenderer* renderer, const Eigen::Vector3d& eye, const Eigen::Vector3d& target, int height);

}  // namespace atrium::render
