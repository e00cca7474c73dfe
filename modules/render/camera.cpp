#include "modules/render/camera.hpp"

#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace atrium::render {
namespace {

Eigen::Vector3d direction_of(View view) {
  switch (view) {
    case View::top: return {0, 0, -1};
    case View::front: return {0, 1, 0};
    case View::back: return {0, -1, 0};
    case View::left: return {1, 0, 0};
    case View::right: return {-1, 0, 0};
    case View::inside: return Eigen::Vector3d(1, 1, 0).normalized();
    default: return Eigen::Vector3d(0.75, 1.0, -1.05).normalized();
  }
}

Eigen::Vector3d corner_of(const Eigen::AlignedBox3d& box, int i) {
  return box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
}

void place(vtkCamera* camera, const Eigen::Vector3d& eye, const Eigen::Vector3d& target, const Eigen::Vector3d& up) {
  camera->SetPosition(eye.x(), eye.y(), eye.z());
  camera->SetFocalPoint(target.x(), target.y(), target.z());
  camera->SetViewUp(up.x(), up.y(), up.z());
}

}  // namespace

void set_view(vtkRenderer* renderer, View view, const Eigen::AlignedBox3d& box, double aspect, bool perspective) {
  auto* camera = renderer->GetActiveCamera();
  const Eigen::Vector3d forward = direction_of(view);
  const Eigen::Vector3d up = view == View::top ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d side = forward.cross(up).normalized();
  const Eigen::Vector3d top = side.cross(forward);
  const Eigen::Vector3d centre = box.center();
  if (view == View::inside) {
    const double back = 0.35 * std::min(box.sizes().x(), box.sizes().y());
    const Eigen::Vector3d eye{centre.x() - back * forward.x(), centre.y() - back * forward.y(),
                              std::min(box.min().z() + 1.6, centre.z() + 0.4 * box.sizes().z())};
    place(camera, eye, eye + forward, up);
    camera->SetViewAngle(75);
  } else {
    double half_width = 0;
    double half_height = 0;
    for (int i = 0; i < 8; ++i) {
      const Eigen::Vector3d arm = corner_of(box, i) - centre;
      half_width = std::max(half_width, std::abs(arm.dot(side)));
      half_height = std::max(half_height, std::abs(arm.dot(top)));
    }
    constexpr double margin = 1.12;
    const double scale = margin * std::max({half_height, half_width / aspect, 1e-3});
    camera->SetParallelProjection(perspective ? 0 : 1);
    camera->SetParallelScale(scale);
    camera->SetViewAngle(30);
    const double away = scale / std::tan(15.0 * std::numbers::pi / 180) + (perspective ? box.diagonal().norm() / 2 : 0);
    place(camera, centre - away * forward, centre, up);
  }
  renderer->ResetCameraClippingRange();
}

void set_view(vtkRenderer* renderer, const Eigen::Vector3d& eye, const Eigen::Vector3d& target,
              const Eigen::AlignedBox3d& /*box*/) {
  auto* camera = renderer->GetActiveCamera();
  const Eigen::Vector3d forward = (target - eye).normalized();
  place(camera, eye, target, std::abs(forward.z()) > 0.999 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ());
  camera->SetViewAngle(60);
  renderer->ResetCameraClippingRange();
}

}  // namespace atrium::render
