#pragma once
#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <utility>
#include <vector>

#include "modules/render/drawing.hpp"

namespace atrium::render {

/// What the parts of Drawing share.
struct Drawing::Impl {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d translation;
  bool has_origin = false;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< in the inputs' frame
  Eigen::AlignedBox3d box;
  std::set<SurfaceClass> classes;
  std::vector<std::pair<vtkActor*, double>> clouds;  ///< with the spacing of their points, metres; 0: lone points
  std::vector<Eigen::Vector3f> points;               ///< of all clouds, thinned
  std::vector<vtkSmartPointer<vtkPolyData>> meshes;
  vtkNew<vtkRenderer> renderer;

  /// From a value's local coordinates to the drawing's, before they are turned.
  Eigen::Vector3d offset(const Eigen::Vector3d& value_origin) {
    if (!has_origin) origin = value_origin;
    has_origin = true;
    return value_origin - origin;
  }
  Eigen::Vector3f place(const Eigen::Vector3d& local, const Eigen::Vector3d& shift) const {
    return (rotation * (local + shift)).cast<float>();
  }
  /// Shows it, coloured by its scalars (red, green, blue) if it has any.
  vtkActor* add(vtkPolyData* data, bool colour_per_cell);
};

}  // namespace atrium::render
