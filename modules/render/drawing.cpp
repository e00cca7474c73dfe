#include "modules/render/drawing.hpp"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "modules/geometry/quantile.hpp"
#include "modules/render/drawing_impl.hpp"
#include "modules/render/point_spacing.hpp"

namespace atrium::render {
namespace {

constexpr std::size_t most_surface_points = 300000;

Eigen::AlignedBox3d trimmed_box(const std::vector<Eigen::Vector3f>& places, double share) {
  Eigen::AlignedBox3d box;
  std::vector<float> values(places.size());
  Eigen::Vector3d low;
  Eigen::Vector3d high;
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(places.begin(), places.end(), values.begin(), [axis](const auto& p) { return p[axis]; });
    const auto [a, b] = trimmed_range(values, share);
    low[axis] = a;
    high[axis] = b;
  }
  box.extend(low);
  box.extend(high);
  return box;
}

/// Points on a triangle, at most `spacing` apart, but not more than 1000 along a side.
void sample(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, double spacing,
            std::vector<Eigen::Vector3f>& points) {
  const double longest = std::max({(b - a).norm(), (c - a).norm(), (c - b).norm()});
  const int steps = static_cast<int>(std::clamp(std::ceil(longest / spacing), 1.0, 1000.0));
  for (int i = 0; i <= steps; ++i)
    for (int k = 0; k <= steps - i; ++k)
      points.emplace_back((a + (b - a) * i / steps + (c - a) * k / steps).cast<float>());
}

}  // namespace

vtkActor* Drawing::Impl::add(vtkPolyData* data, bool colour_per_cell) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  if (colour_per_cell) mapper->SetScalarModeToUseCellData();
  mapper->SetColorModeToDirectScalars();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
  return actor;
}

Drawing::Drawing(const Transform& to_upright, const Eigen::Vector3d& background) : impl_(std::make_unique<Impl>()) {
  impl_->rotation = to_upright.rotation;
  impl_->translation = to_upright.translation;
  // Lines on faces must not sink into them.
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
  impl_->renderer->SetBackground(background.x(), background.y(), background.z());
}
Drawing::~Drawing() = default;

void Drawing::add_points(const Cloud& cloud, const std::vector<std::uint32_t>& chosen,
                         const std::vector<Colour>& colours, double cut_below_top) {
  if (chosen.empty()) return;
  const Eigen::Vector3d shift = impl_->offset(cloud.origin);
  std::vector<Eigen::Vector3f> places;
  places.reserve(chosen.size());
  for (const auto i : chosen) places.push_back(impl_->place(cloud.points[i].cast<double>(), shift));
  const Eigen::AlignedBox3d box = trimmed_box(places, 0.001);
  impl_->box.extend(box);
  const bool cut = cut_below_top > 0 && box.sizes().z() >= 2 * cut_below_top;
  const double top = cut ? box.max().z() - cut_below_top : 1e30;

  const PointSpacing density = point_spacing(places);
  for (const char lone : {0, 1}) {
    vtkNew<vtkPoints> points;
    vtkNew<vtkUnsignedCharArray> colour;
    colour->SetNumberOfComponents(3);
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i].z() > top || density.lone[i] != lone) continue;
      points->InsertNextPoint(places[i].data());
      colour->InsertNextTypedTuple(colours[i].data());
    }
    vtkNew<vtkCellArray> cells;
    cells->InsertNextCell(static_cast<int>(points->GetNumberOfPoints()));
    for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) cells->InsertCellPoint(i);
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetVerts(cells);
    data->GetPointData()->SetScalars(colour);
    auto* actor = impl_->add(data, false);
    actor->GetProperty()->LightingOff();
    impl_->clouds.emplace_back(actor, lone != 0 ? 0 : density.spacing);
  }
  const std::size_t step = places.size() / most_surface_points + 1;
  for (std::size_t i = 0; i < places.size(); i += step) impl_->points.push_back(places[i]);
}

void Drawing::set_point_size(double pixels, double metres_per_pixel, int picture_height) {
  const double least = std::max(1.0, picture_height / 480.0);
  for (const auto& [actor, spacing] : impl_->clouds) {
    const double automatic = std::clamp(std::ceil(1.1 * spacing / metres_per_pixel), least, 4 * least);
    actor->GetProperty()->SetPointSize(static_cast<float>(std::round(pixels > 0 ? pixels : automatic)));
  }
}

void Drawing::add_adjacency(const PlaneMeshes& meshes, const Adjacency& adjacency) {
  const Eigen::Vector3d shift = impl_->offset(meshes.origin);
  vtkNew<vtkPoints> points;
  for (const auto& mesh : meshes.meshes) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const auto& corner : mesh.corners) centre += corner;
    centre /= static_cast<double>(std::max<std::size_t>(mesh.corners.size(), 1));
    const Eigen::Vector3f place = impl_->place(centre, shift);
    points->InsertNextPoint(place.data());
  }
  vtkNew<vtkCellArray> lines;
  for (const auto& edge : adjacency.edges()) {
    lines->InsertNextCell({static_cast<vtkIdType>(edge.a), static_cast<vtkIdType>(edge.b)});
    for (const auto end : {edge.a, edge.b})
      impl_->box.extend(Eigen::Map<const Eigen::Vector3d>(points->GetPoint(static_cast<vtkIdType>(end))));
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(lines);
  auto* actor = impl_->add(data, false);
  actor->GetProperty()->SetColor(0.84, 0.37, 0);
  actor->GetProperty()->LightingOff();
}

std::vector<Eigen::Vector3f> Drawing::surface_points() const {
  std::vector<Eigen::Vector3f> points = impl_->points;
  const double across = impl_->box.sizes().maxCoeff();
  const double spacing = std::max(0.08, across / 400);
  for (const auto& mesh : impl_->meshes) {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    for (vtkIdType t = 0; t < mesh->GetPolys()->GetNumberOfCells(); ++t) {
      mesh->GetPolys()->GetCellAtId(t, size, corners);
      std::array<Eigen::Vector3d, 3> corner;
      for (std::size_t k = 0; k < 3; ++k) mesh->GetPoint(corners[k], corner[k].data());
      sample(corner[0], corner[1], corner[2], spacing, points);
    }
  }
  return points;
}

Eigen::Vector3d Drawing::local(const Eigen::Vector3d& upright) const {
  return upright - impl_->translation - impl_->rotation * impl_->origin;
}
Eigen::AlignedBox3d Drawing::bounds() const { return impl_->box; }
bool Drawing::empty() const { return impl_->box.isEmpty(); }
const std::set<SurfaceClass>& Drawing::classes() const { return impl_->classes; }
vtkRenderer* Drawing::renderer() const { return impl_->renderer; }

}  // namespace atrium::render
