#pragma once
#include <Eigen/Geometry>

class vtkRenderer;

namespace atrium::render {

enum class View { isometric, top, front, back, left, right, inside };

/// Points the renderer's camera at the box (z up). Front looks along +y, left along +x; isometric from the south-west
/// and above; inside stands at eye height (1.6 m above the floor) in the middle. Parallel projection but inside.
void set_view(vtkRenderer* renderer, View view, const Eigen::AlignedBox3d& box, double aspect, bool perspective);

/// An explicit eye and target, metres, relative to the drawing's origin.
void set_view(vtkRenderer* renderer, const Eigen::Vector3d& eye, const Eigen::Vector3d& target,
              const Eigen::AlignedBox3d& box);

}  // namespace atrium::render
