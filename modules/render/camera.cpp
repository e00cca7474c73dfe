#include "modules/render/camera.hpp"

#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
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

double set_view(vtkRenderer* renderer, View view, const Eigen::AlignedBox3d& box, int width, int height,
                int right_margin, bool perspective) {
  auto* camera = renderer->GetActiveCamera();
  const Eigen::Vector3d forward = direction_of(view);
  const Eigen::Vector3d up = view == View::top ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d side = forward.cross(up).normalized();
  const Eigen::Vector3d top = side.cross(forward);
  const Eigen::Vector3d centre = box.center();
  double half_width = 0;
  double half_height = 0;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d arm = corner_of(box, i) - centre;
    half_width = std::max(half_width, std::abs(arm.dot(side)));
    half_height = std::max(half_height, std::abs(arm.dot(top)));
  }
  constexpr double margin = 1.12;
  const double scale = margin * std::max({half_height, half_width * height / (width - right_margin), 1e-3});
  camera->SetParallelProjection(perspective ? 0 : 1);
  camera->SetParallelScale(scale);
  camera->SetViewAngle(30);
  camera->SetWindowCenter(static_cast<double>(right_margin) / width, 0);
  const double away = scale / std::tan(15.0 * std::numbers::pi / 180) + (perspective ? box.diagonal().norm() / 2 : 0);
  place(camera, centre - away * forward, centre, up);
  renderer->ResetCameraClippingRange();
  return 2 * scale / height;
}

double set_view(vtkRenderer* renderer, const Eigen::Vector3d& eye, const Eigen::Vector3d& target, int height) {
  constexpr double angle = 62;
  constexpr double distance = 3;
  auto* camera = renderer->GetActiveCamera();
  const Eigen::Vector3d forward = (target - eye).normalized();
  place(camera, eye, target, std::abs(forward.z()) > 0.999 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ());
  camera->SetParallelProjection(0);
  camera->SetViewAngle(angle);
  renderer->ResetCameraClippingRange();
  return 2 * distance * std::tan(angle / 2 * std::numbers::pi / 180) / height;
}

}  // namespace atrium::render
