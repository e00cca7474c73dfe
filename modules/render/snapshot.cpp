#include "modules/render/snapshot.hpp"

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "modules/render/camera.hpp"
#include "modules/render/drawing.hpp"
#include "modules/render/offscreen_window.hpp"
#include "modules/render/overlay.hpp"
#include "modules/render/png.hpp"
#include "modules/types/palette.hpp"

namespace atrium::render {
namespace {

using Params = Snapshot::Params;

constexpr std::array<std::pair<std::string_view, View>, 7> view_names{{{"isometric", View::isometric},
                                                                       {"top", View::top},
                                                                       {"front", View::front},
                                                                       {"back", View::back},
                                                                       {"left", View::left},
                                                                       {"right", View::right},
                                                                       {"inside", View::inside}}};

View view_of(const std::string& name) {
  for (const auto& [known, view] : view_names)
    if (known == name) return view;
  throw Error("there is no view '" + name + "'", "views are isometric, top, front, back, left, right and inside");
}

/// A perceptually even ramp from blue over green to yellow (five stops of viridis).
Colour ramp(double t) {
  constexpr std::array<std::array<double, 3>, 5> stops{
      {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};
  const double x = std::clamp(t, 0.0, 1.0) * 4;
  const auto i = std::min<std::size_t>(static_cast<std::size_t>(x), 3);
  Colour colour{};
  for (std::size_t k = 0; k < 3; ++k)
    colour[k] = static_cast<std::uint8_t>(
        std::lround(stops[i][k] + (x - static_cast<double>(i)) * (stops[i + 1][k] - stops[i][k])));
  return colour;
}

std::vector<Colour> height_colours(const Cloud& cloud, const Eigen::Matrix3d& to_upright) {
  const Eigen::Vector3f up = to_upright.row(2).transpose().cast<float>();
  std::vector<float> heights(cloud.size());
  std::transform(cloud.points.begin(), cloud.points.end(), heights.begin(), [&](const auto& p) { return up.dot(p); });
  std::vector<float> sorted = heights;
  std::sort(sorted.begin(), sorted.end());
  const float low = sorted[sorted.size() / 200];
  const float high = sorted[sorted.size() - 1 - sorted.size() / 200];
  std::vector<Colour> colours(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) colours[i] = ramp((heights[i] - low) / std::max(high - low, 1e-3F));
  return colours;
}

std::vector<Colour> cloud_colours(const Cloud& cloud, Snapshot::ColourBy by, const Eigen::Matrix3d& to_upright) {
  using By = Snapshot::ColourBy;
  if (by == By::automatic) by = cloud.colours.empty() ? By::height : By::colour;
  if (by == By::colour && cloud.colours.empty())
    throw Error("the cloud has no colours", "colour_by: height draws any cloud");
  if (by == By::label && cloud.labels.empty())
    throw Error("the cloud has no labels", "colour_by: height draws any cloud");
  if (by == By::colour) return cloud.colours;
  if (by == By::height) return height_colours(cloud, to_upright);
  std::vector<Colour> colours(cloud.size(), Colour{110, 110, 110});
  if (by == By::label)
    for (std::size_t i = 0; i < cloud.size(); ++i)
      if (cloud.labels[i] >= 0) colours[i] = index_colour(static_cast<std::size_t>(cloud.labels[i]));
  return colours;
}

std::vector<Colour> primitive_colours(const PlanePrimitives& planes) {
  std::vector<Colour> colours(planes.cloud->size(), Colour{200, 200, 200});
  for (std::size_t k = 0; k < planes.primitives.size(); ++k)
    for (const auto i : planes.primitives[k].inliers) colours[i] = index_colour(k);
  return colours;
}

/// The points of structural primitives, each in the colour of its class.
Cloud structural_points(const Structure& structure, bool ceilings) {
  const PlanePrimitives& planes = *structure.primitives;
  std::vector<std::uint32_t> chosen;
  std::vector<Colour> colours;
  for (std::size_t k = 0; k < planes.primitives.size(); ++k) {
    const SurfaceClass surface = structure.classes[k];
    if (surface == SurfaceClass::object || (surface == SurfaceClass::ceiling && !ceilings)) continue;
    const auto& inliers = planes.primitives[k].inliers;
    chosen.insert(chosen.end(), inliers.begin(), inliers.end());
    colours.insert(colours.end(), inliers.size(), class_colour(surface));
  }
  Cloud cloud = select(*planes.cloud, chosen);
  cloud.colours = std::move(colours);
  return cloud;
}

Mesh triangulated(const PlaneMeshes& meshes) {
  Mesh result;
  result.origin = meshes.origin;
  for (const auto& m : meshes.meshes) {
    const auto first = static_cast<std::uint32_t>(result.vertices.size());
    result.vertices.insert(result.vertices.end(), m.corners.begin(), m.corners.end());
    for (std::uint32_t k = 2; k < m.corners.size(); ++k) {
      result.triangles.push_back({first, first + k - 1, first + k});
      result.classes.push_back(m.surface);
      result.primitives.push_back(m.primitive);
    }
  }
  return result;
}

void add_inputs(Drawing& drawing, const Snapshot::In& in, const Params& params, bool from_above,
                const Eigen::Matrix3d& to_upright) {
  const Drawing::CloudStyle points{params.point_size, 2000000,
                                   from_above && !params.ceilings ? params.cut_below_top : 0};
  if (in.cloud && !in.cloud->points.empty())
    drawing.add_cloud(*in.cloud, cloud_colours(*in.cloud, params.colour_by, to_upright), points);
  if (in.planes && !in.planes->cloud->points.empty())
    drawing.add_cloud(*in.planes->cloud, primitive_colours(*in.planes), points);
  if (in.structure) {
    const Cloud cloud = structural_points(*in.structure, params.ceilings);
    drawing.add_cloud(cloud, cloud.colours, {params.point_size, 2000000, 0});
  }
  const Drawing::MeshStyle surfaces{params.edges, !params.ceilings, params.ceilings, false};
  if (in.meshes) drawing.add_mesh(triangulated(*in.meshes), surfaces);
  if (in.meshes && in.adjacency) drawing.add_adjacency(*in.meshes, *in.adjacency);
  if (in.mesh) drawing.add_mesh(*in.mesh, surfaces);
  if (in.truth) drawing.add_mesh(in.truth->mesh, surfaces);
  if (in.objects) drawing.add_mesh(*in.objects, {false, false, true, true});
}

std::vector<std::pair<std::string, Colour>> legend_of(const Snapshot::In& in, bool ceilings) {
  std::vector<std::pair<std::string, Colour>> legend;
  if (!in.meshes && !in.mesh && !in.truth && !in.structure) return legend;
  for (const auto surface : {SurfaceClass::wall, SurfaceClass::floor, SurfaceClass::ceiling, SurfaceClass::object})
    if (ceilings || surface != SurfaceClass::ceiling)
      legend.emplace_back(std::string(name_of(surface)), class_colour(surface));
  return legend;
}

Picture grab(vtkRenderWindow* window, int width, int height) {
  window->Render();
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetPixelData(0, 0, width - 1, height - 1, 0, pixels);
  Picture picture{width, height, {}, {}};
  const std::size_t row = 3 * static_cast<std::size_t>(width);
  picture.pixels.resize(row * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y)
    std::memcpy(picture.pixels.data() + row * static_cast<std::size_t>(y),
                pixels->GetPointer(static_cast<vtkIdType>(row) * (height - 1 - y)), row);
  return picture;
}

Eigen::Vector3d vector_of(const std::vector<double>& v, const char* name) {
  if (v.size() != 3) throw Error(std::string("'") + name + "' needs three numbers [x, y, z]");
  return {v[0], v[1], v[2]};
}

Picture draw(const Snapshot::In& in, const Params& params, const std::string& view_name) {
  const Transform to_upright = in.transform ? *in.transform : Transform{};
  const bool dark = params.background == Snapshot::Background::black;
  const bool explicit_camera = view_name == "camera";
  const View view = explicit_camera ? View::inside : view_of(view_name);
  const int width = static_cast<int>(params.width);
  const int height = static_cast<int>(params.height);

  Drawing drawing(to_upright, dark ? Eigen::Vector3d::Zero() : Eigen::Vector3d::Ones());
  add_inputs(drawing, in, params, view == View::isometric || view == View::top, to_upright.rotation);
  if (drawing.empty())
    throw Error("there is nothing to draw", "wire a cloud, planes, meshes or a mesh that is not empty");
  if (explicit_camera)
    set_view(drawing.renderer(), vector_of(params.eye, "eye"), vector_of(params.target, "target"), drawing.bounds());
  else
    set_view(drawing.renderer(), view, drawing.bounds(), static_cast<double>(width) / height, params.perspective);

  Overlay overlay;
  overlay.title = params.title;
  overlay.dark_background = dark;
  if (params.legend) overlay.legend = legend_of(in, params.ceilings);
  auto* camera = drawing.renderer()->GetActiveCamera();
  if (params.scale_bar && camera->GetParallelProjection() != 0)
    overlay.scale_bar = 2 * camera->GetParallelScale() * width / height;
  add_overlay(drawing.renderer(), overlay, width, height);

  OffscreenWindow window(width, height);
  window.get()->AddRenderer(drawing.renderer());
  Picture picture = grab(window.get(), width, height);
  picture.caption = params.title.empty() ? view_name : params.title;
  window.get()->RemoveRenderer(drawing.renderer());
  return picture;
}

}  // namespace

Snapshot::Out Snapshot::run(const In& in, const Params& params, Context& context) {
  std::vector<std::string> views = params.views;
  if (!params.eye.empty() || !params.target.empty()) views = {"camera"};
  if (views.empty()) throw Error("no view is asked for", "views: [isometric, top]");
  for (const auto& name : views)
    if (name != "camera" || params.eye.empty()) view_of(name);

  Out out;
  const std::filesystem::path path = context.output(params.path.path);
  for (std::size_t i = 0; i < views.size(); ++i) {
    context.check_cancelled();
    {
      const RenderLock lock;
      out.pictures.pictures.push_back(draw(in, params, views[i]));
    }
    std::filesystem::path file = path;
    if (views.size() > 1) file.replace_filename(path.stem().string() + "_" + views[i] + path.extension().string());
    write_png(out.pictures.pictures.back(), file);
    context.wrote(file);
    context.progress(static_cast<double>(i + 1) / static_cast<double>(views.size()));
  }
  return out;
}

}  // namespace atrium::render
