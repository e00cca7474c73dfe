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
#include "modules/render/inside_view.hpp"
#include "modules/render/offscreen_window.hpp"
#include "modules/render/png.hpp"
#include "modules/render/stage.hpp"

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
  for (const double number : v)
    if (!std::isfinite(number)) throw Error(std::string("'") + name + "' is not a place: a number is not finite");
  return {v[0], v[1], v[2]};
}

/// The explicit camera: its eye and its target in the drawing's coordinates. One that fits leaves a margin (pixels).
std::pair<Eigen::Vector3d, Eigen::Vector3d> explicit_camera(const Drawing& drawing, const Params& params,
                                                            double field_of_view, int margin) {
  const Eigen::Vector3d eye = drawing.local(vector_of(params.eye, "eye"));
  const Eigen::Vector3d target = drawing.local(vector_of(params.target, "target"));
  if ((target - eye).norm() < 1e-6) throw Error("'eye' and 'target' are the same place", "look at another place");
  if (!params.fit) return {eye, target};
  const Eigen::AlignedBox3d box = drawing.bounds();
  const int width = static_cast<int>(params.width) - margin;
  return {fitted_eye(box, target - eye, field_of_view, width, static_cast<int>(params.height)), box.center()};
}

Camera camera_of(const std::string& view_name) {
  if (view_name == "camera") return Camera::placed;
  if (view_of(view_name) == View::inside) return Camera::inside;
  return view_name == "isometric" || view_name == "top" ? Camera::above : Camera::level;
}

/// Sets the camera up and sizes the points for it.
void aim(Drawing& drawing, const Params& params, const std::string& view_name, const Overlay& overlay) {
  const int width = static_cast<int>(params.width);
  const int height = static_cast<int>(params.height);
  const int margin =
      overlay.colours ? std::min(width / 2, static_cast<int>(colour_bar_width * params.text_size * height)) : 0;
  const Camera camera = camera_of(view_name);
  const double usual_field = camera <= Camera::level ? 30 : 62;
  const double field_of_view = params.field_of_view > 0 ? params.field_of_view : usual_field;
  double metres_per_pixel = 0;
  if (camera == Camera::placed) {
    const auto [eye, target] = explicit_camera(drawing, params, field_of_view, margin);
    metres_per_pixel = set_view(drawing.renderer(), eye, target, field_of_view, height);
    if (params.fit) drawing.renderer()->GetActiveCamera()->SetWindowCenter(static_cast<double>(margin) / width, 0);
  } else if (camera == Camera::inside) {
    const Viewpoint place = inside_view(drawing.surface_points());
    metres_per_pixel = set_view(drawing.renderer(), place.eye, place.target, field_of_view, height);
  } else {
    metres_per_pixel = set_view(drawing.renderer(), view_of(view_name), drawing.bounds(),
                                {width, height, margin, params.perspective, field_of_view, params.view_width});
    if (const auto plates = plates_of(overlay, width, height); !plates.empty() && params.view_width == 0)
      metres_per_pixel /= make_room(drawing.renderer(), drawing.surface_points(), plates, width, height);
  }
  drawing.set_point_size(params.point_size, metres_per_pixel, height);
}

Picture draw(const Snapshot::In& in, const Params& params, const std::string& view_name, const Context& context) {
  const bool dark = params.background == Snapshot::Background::black;
  const int width = static_cast<int>(params.width);
  const int height = static_cast<int>(params.height);

  Drawing drawing(in.transform ? *in.transform : Transform{}, dark ? Eigen::Vector3d::Zero() : Eigen::Vector3d::Ones());
  Overlay overlay;
  add_inputs(drawing, overlay, in, params, camera_of(view_name), context);
  const bool blank = drawing.empty();
  if (blank && params.empty == Snapshot::Empty::error)
    throw Error(
        "there is nothing to draw",
        "wire a cloud, planes, meshes or a mesh that is not empty; `ceilings: true` draws ceilings too, `empty: "
        "blank` makes a picture that says so");
  overlay.title = blank ? "nothing to draw" : params.title;
  overlay.text_size = params.text_size;
  overlay.dark_background = dark;
  if (!params.legend) overlay.legend.clear();
  if (!params.scale_bar) overlay.colours.reset();
  if (!blank) aim(drawing, params, view_name, overlay);
  auto* camera = drawing.renderer()->GetActiveCamera();
  if (!blank && params.scale_bar && camera->GetParallelProjection() != 0)
    overlay.scale_bar = 2 * camera->GetParallelScale() * width / height;
  vtkNew<vtkRenderer> front;
  front->SetLayer(1);
  add_overlay(drawing.renderer(), front, overlay, width, height);

  OffscreenWindow window(width, height);
  window.get()->SetNumberOfLayers(2);
  window.get()->AddRenderer(drawing.renderer());
  window.get()->AddRenderer(front);
  Picture picture = grab(window.get(), width, height);
  picture.caption = params.title.empty() ? view_name : params.title;
  window.get()->RemoveRenderer(front);
  window.get()->RemoveRenderer(drawing.renderer());
  return picture;
}

}  // namespace

Snapshot::Out Snapshot::run(const In& in, const Params& params, Context& context) {
  std::vector<std::string> views = params.views;
  if (!params.eye.empty() || !params.target.empty()) views = {"camera"};
  if (views.empty()) throw Error("no view is asked for", "views: [isometric, top]");
  for (const auto& name : views)
    if (name != "camera" || (params.eye.empty() && params.target.empty())) view_of(name);
  for (auto view = views.begin(); view != views.end(); ++view)
    if (std::find(views.begin(), view, *view) != view)
      throw Error("the view '" + *view + "' is asked for twice", "name each view once");
  require_png_name(params.path.path);

  Out out;
  const std::filesystem::path path = context.output(params.path.path);
  for (std::size_t i = 0; i < views.size(); ++i) {
    context.check_cancelled();
    {
      const RenderLock lock;
      out.pictures.pictures.push_back(draw(in, params, views[i], context));
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
