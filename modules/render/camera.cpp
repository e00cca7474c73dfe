#include "modules/render/camera.hpp"

#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
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

double tan_half(double degrees) { return std::tan(degrees / 2 * std::numbers::pi / 180); }

/// What is up in a picture that is taken along a direction.
Eigen::Vector3d upright_for(const Eigen::Vector3d& forward) {
  return std::abs(forward.z()) > 0.999 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
}

}  // namespace

double set_view(vtkRenderer* renderer, View view, const Eigen::AlignedBox3d& box, const Frame& frame) {
  const auto& [width, height, right_margin, perspective, field_of_view, view_width] = frame;
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
  const double fitted = margin * std::max({half_height, half_width * height / (width - right_margin), 1e-3});
  const double scale = view_width > 0 ? view_width / 2 * height / width : fitted;
  camera->SetParallelProjection(perspective ? 0 : 1);
  camera->SetParallelScale(scale);
  camera->SetViewAngle(field_of_view);
  camera->SetWindowCenter(static_cast<double>(right_margin) / width, 0);
  const double away =
      scale / tan_half(field_of_view) + (perspective && view_width == 0 ? box.diagonal().norm() / 2 : 0);
  place(camera, centre - away * forward, centre, up);
  renderer->ResetCameraClippingRange();
  return 2 * scale / height;
}

double set_view(vtkRenderer* renderer, const Eigen::Vector3d& eye, const Eigen::Vector3d& target, double field_of_view,
                int height) {
  constexpr double distance = 3;
  auto* camera = renderer->GetActiveCamera();
  const Eigen::Vector3d forward = (target - eye).normalized();
  place(camera, eye, target, upright_for(forward));
  camera->SetParallelProjection(0);
  camera->SetViewAngle(field_of_view);
  renderer->ResetCameraClippingRange();
  return 2 * distance * tan_half(field_of_view) / height;
}

Eigen::Vector3d fitted_eye(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& direction, double field_of_view,
                           int width, int height) {
  constexpr double margin = 1.05;
  const Eigen::Vector3d forward = direction.normalized();
  const Eigen::Vector3d up = upright_for(forward);
  const Eigen::Vector3d side = forward.cross(up).normalized();
  const Eigen::Vector3d top = side.cross(forward);
  const double down = tan_half(field_of_view) / margin;
  const double across = down * width / height;
  double away = 1e-3;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d arm = corner_of(box, i) - box.center();
    away = std::max(away, std::max(std::abs(arm.dot(side)) / across, std::abs(arm.dot(top)) / down) - arm.dot(forward));
  }
  return box.center() - away * forward;
}

double make_room(vtkRenderer* renderer, const std::vector<Eigen::Vector3f>& points,
                 const std::vector<Eigen::AlignedBox2d>& plates, int width, int height) {
  constexpr double step = 0.97;
  constexpr double least = 0.7;
  auto* camera = renderer->GetActiveCamera();
  const auto hides = [&] {
    Eigen::Matrix4d seen;
    auto* matrix = camera->GetCompositeProjectionTransformMatrix(static_cast<double>(width) / height, -1, 1);
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c) seen(r, c) = matrix->GetElement(r, c);
    return std::any_of(points.begin(), points.end(), [&](const Eigen::Vector3f& point) {
      const Eigen::Vector4d place = seen * point.cast<double>().homogeneous();
      const Eigen::Vector2d pixel =
          (place.head<2>() / place.w() + Eigen::Vector2d::Ones()).cwiseProduct(Eigen::Vector2d(width, height)) / 2;
      return std::any_of(plates.begin(), plates.end(), [&](const auto& plate) { return plate.contains(pixel); });
    });
  };
  double size = 1;
  while (size > least && hides()) {
    size *= step;
    if (camera->GetParallelProjection() != 0)
      camera->SetParallelScale(camera->GetParallelScale() / step);
    else
      camera->Dolly(step);
  }
  renderer->ResetCameraClippingRange();
  return size;
}

}  // namespace atrium::render
