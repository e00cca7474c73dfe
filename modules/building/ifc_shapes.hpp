#pragma once
#include <Eigen/Core>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "modules/building/step_file.hpp"
#include "modules/types/floor_plan.hpp"

namespace atrium::building {

/// A right-handed frame: location, z axis, x axis.
struct IfcFrame {
  Eigen::Vector3d location = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d across = Eigen::Vector3d::UnitX();
};

/// A closed surface of polygons.
struct PolygonSurface {
  struct Face {
    std::vector<std::uint32_t> outline;  ///< counter-clockwise seen from outside
    std::vector<std::vector<std::uint32_t>> holes;
  };
  std::vector<Eigen::Vector3d> points;
  std::vector<Face> faces;
};

/// What elements have in common: colours of surfaces and their places in the file.
class IfcShapes {
 public:
  explicit IfcShapes(StepFile& file);

  StepFile& file() { return file_; }
  StepRef model_context() const { return model_; }

  StepRef point(const Eigen::Vector3d& p);
  StepRef point(const Eigen::Vector2d& p);
  StepRef direction(const Eigen::Vector3d& d);
  StepRef axes(const IfcFrame& frame);  ///< IfcAxis2Placement3D
  StepRef placement(StepRef parent, const IfcFrame& frame);
  StepRef polyline(const PlanRing& corners, bool closed);
  StepRef profile(const PlanPolygon& polygon);

  /// Solids, coloured by class ("wall", "slab" …).
  StepRef extruded(const PlanPolygon& polygon, const IfcFrame& frame, const Eigen::Vector3d& direction, double depth,
                   std::string_view colour);
  StepRef faceted(const PolygonSurface& surface, std::string_view colour);
  StepRef triangles(const std::vector<Eigen::Vector3d>& points,
                    const std::vector<std::array<std::uint32_t, 3>>& corners, bool closed, std::string_view colour);

  /// A product's shape: its body, and what else there is.
  StepRef body(const std::vector<StepRef>& items, std::string_view type);
  StepRef axis_line(const Eigen::Vector2d& from, const Eigen::Vector2d& to);
  StepRef shape(const std::vector<StepRef>& representations);

 private:
  void paint(StepRef item, std::string_view colour);
  StepFile& file_;
  StepRef model_, body_, axis_;
};

/// A prism of the polygon with straight sides, its foot and head at given heights per corner of the rings, in order.
PolygonSurface prism(const PlanPolygon& polygon, const std::vector<double>& low, const std::vector<double>& high);

}  // namespace atrium::building
