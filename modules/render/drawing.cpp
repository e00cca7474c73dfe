#include "modules/render/drawing.hpp"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <map>

#include "modules/types/palette.hpp"

namespace atrium::render {

struct Drawing::Impl {
  Eigen::Matrix3d rotation;
  bool has_origin = false;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::AlignedBox3d box;
  vtkNew<vtkRenderer> renderer;

  /// From a value's local coordinates to the drawing's.
  Eigen::Vector3d offset(const Eigen::Vector3d& value_origin) {
    if (!has_origin) origin = value_origin;
    has_origin = true;
    return value_origin - origin;
  }
  Eigen::Vector3f place(const Eigen::Vector3d& local, const Eigen::Vector3d& shift) const {
    return (rotation * (local + shift)).cast<float>();
  }
  vtkActor* add(vtkPolyData* data, bool per_cell) {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(data);
    if (per_cell) mapper->SetScalarModeToUseCellData();
    mapper->SetColorModeToDirectScalars();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    renderer->AddActor(actor);
    return actor;
  }
};

namespace {

/// Drops the outermost `share` of the values at each end.
std::pair<float, float> trimmed_range(std::vector<float> values, double share) {
  const auto cut = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  std::nth_element(values.begin(), values.begin() + cut, values.end());
  const float low = values[static_cast<std::size_t>(cut)];
  std::nth_element(values.begin(), values.end() - 1 - cut, values.end());
  return {low, *(values.end() - 1 - cut)};
}

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

void style_surface(vtkActor* actor) {
  auto* property = actor->GetProperty();
  property->SetInterpolationToFlat();
  property->SetAmbient(0.45);
  property->SetDiffuse(0.55);
  property->SetSpecular(0);
}

}  // namespace

std::vector<std::pair<std::uint32_t, std::uint32_t>> outline_edges(const Mesh& mesh) {
  struct Use {
    int count = 0;
    std::int32_t primitive = -1;
    bool border = false;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Use> uses;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto primitive = mesh.primitives.empty() ? -1 : mesh.primitives[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto edge = std::minmax({mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]});
      Use& use = uses[edge];
      use.border = use.count > 0 && use.primitive != primitive;
      use.primitive = primitive;
      ++use.count;
    }
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> result;
  for (const auto& [edge, use] : uses)
    if (use.count == 1 || use.border) result.push_back(edge);
  return result;
}

Drawing::Drawing(const Transform& to_upright, const Eigen::Vector3d& background) : impl_(std::make_unique<Impl>()) {
  impl_->rotation = to_upright.rotation;
  impl_->renderer->SetBackground(background.x(), background.y(), background.z());
}
Drawing::~Drawing() = default;

void Drawing::add_cloud(const Cloud& cloud, const std::vector<Colour>& colours, const CloudStyle& style) {
  if (cloud.points.empty()) return;
  const Eigen::Vector3d shift = impl_->offset(cloud.origin);
  const std::size_t step = (cloud.size() + style.max_points - 1) / style.max_points;
  std::vector<Eigen::Vector3f> places;
  std::vector<Colour> shown;
  for (std::size_t i = 0; i < cloud.size(); i += step) {
    places.push_back(impl_->place(cloud.points[i].cast<double>(), shift));
    shown.push_back(colours[i]);
  }
  const Eigen::AlignedBox3d box = trimmed_box(places, 0.001);
  impl_->box.extend(box);
  const double top = style.cut_below_top > 0 ? box.max().z() - style.cut_below_top : 1e30;

  vtkNew<vtkPoints> points;
  vtkNew<vtkUnsignedCharArray> colour;
  colour->SetNumberOfComponents(3);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].z() > top) continue;
    points->InsertNextPoint(places[i].data());
    colour->InsertNextTypedTuple(shown[i].data());
  }
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(points->GetNumberOfPoints());
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) cells->InsertCellPoint(i);
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetVerts(cells);
  data->GetPointData()->SetScalars(colour);
  auto* actor = impl_->add(data, false);
  actor->GetProperty()->SetPointSize(static_cast<float>(style.point_size));
  actor->GetProperty()->LightingOff();
}

void Drawing::add_mesh(const Mesh& mesh, const MeshStyle& style) {
  if (mesh.triangles.empty()) return;
  const Eigen::Vector3d shift = impl_->offset(mesh.origin);
  vtkNew<vtkPoints> points;
  for (const auto& v : mesh.vertices) {
    const Eigen::Vector3f place = impl_->place(v, shift);
    points->InsertNextPoint(place.data());
    impl_->box.extend(place.cast<double>());
  }
  Mesh shown;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> colour;
  colour->SetNumberOfComponents(3);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto surface = mesh.classes.empty() ? SurfaceClass::object : mesh.classes[t];
    if (!style.ceilings && surface == SurfaceClass::ceiling) continue;
    cells->InsertNextCell({mesh.triangles[t][0], mesh.triangles[t][1], mesh.triangles[t][2]});
    colour->InsertNextTypedTuple(class_colour(surface).data());
    if (surface == SurfaceClass::object) continue;
    shown.triangles.push_back(mesh.triangles[t]);
    shown.primitives.push_back(mesh.primitives.empty() ? -1 : mesh.primitives[t]);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  const bool by_vertex = style.vertex_colours && !mesh.colours.empty();
  if (by_vertex) {
    colour->Reset();
    for (const auto& c : mesh.colours) colour->InsertNextTypedTuple(c.data());
    data->GetPointData()->SetScalars(colour);
  } else {
    data->GetCellData()->SetScalars(colour);
  }
  auto* actor = impl_->add(data, !by_vertex);
  style_surface(actor);
  actor->GetProperty()->SetBackfaceCulling(style.inside ? 1 : 0);
  if (!style.edges) return;

  vtkNew<vtkCellArray> lines;
  for (const auto& [a, b] : outline_edges(shown)) lines->InsertNextCell({a, b});
  vtkNew<vtkPolyData> outline;
  outline->SetPoints(points);
  outline->SetLines(lines);
  auto* edges = impl_->add(outline, false);
  edges->GetProperty()->SetColor(0.15, 0.15, 0.15);
  edges->GetProperty()->LightingOff();
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
    impl_->box.extend(place.cast<double>());
  }
  vtkNew<vtkCellArray> lines;
  for (const auto& edge : adjacency.edges())
    lines->InsertNextCell({static_cast<vtkIdType>(edge.a), static_cast<vtkIdType>(edge.b)});
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(lines);
  auto* actor = impl_->add(data, false);
  actor->GetProperty()->SetColor(0.8, 0.2, 0.2);
  actor->GetProperty()->LightingOff();
}

Eigen::AlignedBox3d Drawing::bounds() const { return impl_->box; }
bool Drawing::empty() const { return impl_->box.isEmpty(); }
vtkRenderer* Drawing::renderer() const { return impl_->renderer; }

}  // namespace atrium::render
