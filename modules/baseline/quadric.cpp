#include "modules/baseline/quadric.hpp"

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>

#include <algorithm>
#include <numeric>

#include "modules/baseline/input_mesh.hpp"
#include "modules/geometry/point_tree.hpp"

namespace atrium::baseline {
namespace {

using Corners = std::array<std::uint32_t, 3>;

// About `centre`, so that VTK's products keep their digits.
vtkNew<vtkPolyData> to_vtk(const Mesh& mesh, const Eigen::Vector3d& centre) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.vertices.size()));
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    points->SetPoint(static_cast<vtkIdType>(i), Eigen::Vector3d(mesh.vertices[i] - centre).data());
  vtkNew<vtkCellArray> cells;
  for (const auto& t : mesh.triangles) cells->InsertNextCell({t[0], t[1], t[2]});
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

Mesh from_vtk(vtkPolyData& data, const Eigen::Vector3d& centre) {
  std::vector<Eigen::Vector3d> places(static_cast<std::size_t>(data.GetNumberOfPoints()));
  for (std::size_t i = 0; i < places.size(); ++i)
    places[i] = Eigen::Vector3d(data.GetPoint(static_cast<vtkIdType>(i))) + centre;
  Mesh mesh;
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < data.GetPolys()->GetNumberOfCells(); ++i) {
    data.GetPolys()->GetCellAtId(i, corners);
    Corners triangle{};
    for (vtkIdType k = 0; k < 3; ++k)
      triangle[static_cast<std::size_t>(k)] = static_cast<std::uint32_t>(corners->GetId(k));
    mesh.triangles.push_back(triangle);
  }
  place_used_vertices(places, {}, mesh);
  return mesh;
}

void end_if_cancelled(vtkObject* caller, unsigned long /*event*/, void* context, void* /*data*/) {
  auto* filter = static_cast<vtkQuadricDecimation*>(caller);
  static_cast<const Context*>(context)->progress(filter->GetProgress());
  if (static_cast<const Context*>(context)->cancelled()) filter->SetAbortExecute(1);
}

Mesh decimated(const Mesh& mesh, std::size_t target, bool volume_preservation, Context& context) {
  const Eigen::Vector3d centre =
      std::accumulate(mesh.vertices.begin(), mesh.vertices.end(), Eigen::Vector3d(Eigen::Vector3d::Zero())) /
      static_cast<double>(mesh.vertices.size());
  vtkNew<vtkCallbackCommand> watch;
  watch->SetCallback(end_if_cancelled);
  watch->SetClientData(&context);
  vtkNew<vtkQuadricDecimation> filter;
  filter->AddObserver(vtkCommand::ProgressEvent, watch);
  filter->SetInputData(to_vtk(mesh, centre));
  // VTK ends at the first share of removed triangles that is not below this one: half a triangle makes it exact.
  filter->SetTargetReduction(1 - (static_cast<double>(target) + 0.5) / static_cast<double>(mesh.triangles.size()));
  filter->SetVolumePreservation(volume_preservation);
  filter->Update();
  context.check_cancelled();
  return from_vtk(*filter->GetOutput(), centre);
}

void colour_by_nearest(const Mesh& source, Mesh& mesh, const Context& context) {
  if (source.colours.empty()) return;
  std::vector<Eigen::Vector3f> points;
  points.reserve(source.vertices.size());
  for (const auto& v : source.vertices) points.emplace_back(v.cast<float>());
  const PointTree tree(points, context);
  mesh.colours.resize(mesh.vertices.size());
  context.parallel_for(mesh.vertices.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Neighbour nearest;
      tree.nearest(mesh.vertices[i].cast<float>(), nearest);
      mesh.colours[i] = source.colours[nearest.index];
    }
  });
}

}  // namespace

Quadric::Out Quadric::run(const In& in, const Params& params, Context& context) {
  check_mesh(*in.mesh);
  const std::size_t target = target_triangles(in.mesh->triangles.size(), params.triangles, params.ratio);
  Out out;
  out.mesh = without_repeated_corners(*in.mesh);
  if (out.mesh.triangles.size() <= target) return out;
  const Mesh source = std::move(out.mesh);
  out.mesh = decimated(source, target, params.volume_preservation, context);
  out.mesh.origin = source.origin;
  colour_by_nearest(source, out.mesh, context);
  if (out.mesh.triangles.size() > target)
    context.warn(fmt::format("no edge can be collapsed any more at {} triangles, {} were wanted",
                             out.mesh.triangles.size(), target));
  return out;
}

}  // namespace atrium::baseline
