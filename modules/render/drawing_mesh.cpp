// The part of Drawing that draws meshes.
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTexture.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>

#include "graph/api/error.hpp"
#include "modules/render/drawing_impl.hpp"
#include "modules/render/drawn_box.hpp"
#include "modules/types/palette.hpp"

namespace atrium::render {
namespace {

void style_surface(vtkActor* actor, bool textured) {
  auto* property = actor->GetProperty();
  property->SetInterpolationToFlat();
  property->SetAmbient(textured ? 0.8 : 0.6);
  property->SetDiffuse(textured ? 0.2 : 0.4);
  property->SetSpecular(0);
}

/// VTK counts rows from the bottom.
vtkSmartPointer<vtkTexture> texture_of(const FaceTexture& face) {
  const std::size_t row = 3 * static_cast<std::size_t>(std::max(face.width, 0));
  if (face.width < 1 || face.height < 1 || face.pixels.size() != row * static_cast<std::size_t>(face.height))
    throw Error("the image of primitive " + std::to_string(face.primitive) +
                " has not as many pixels as its size says");
  vtkNew<vtkImageData> image;
  image->SetDimensions(face.width, face.height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int y = 0; y < face.height; ++y)
    std::memcpy(image->GetScalarPointer(0, face.height - 1 - y, 0),
                face.pixels.data() + row * static_cast<std::size_t>(y), row);
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(image);
  texture->InterpolateOn();
  texture->MipmapOn();
  texture->RepeatOff();
  texture->EdgeClampOn();
  texture->SetColorModeToDirectScalars();
  return texture;
}

/// Where the mesh's vertices lie on the image: 0 … 1 from its left and from its bottom.
vtkSmartPointer<vtkFloatArray> places_on(const FaceTexture& face, const Mesh& mesh, const Eigen::Vector3d& shift) {
  auto places = vtkSmartPointer<vtkFloatArray>::New();
  places->SetNumberOfComponents(2);
  for (const auto& vertex : mesh.vertices) {
    const Eigen::Vector3d arm = vertex + shift - face.corner;
    places->InsertNextTuple2(arm.dot(face.across) / face.across.squaredNorm(),
                             1 - arm.dot(face.down) / face.down.squaredNorm());
  }
  return places;
}

/// All vertices, those that no triangle uses at another one's place: VTK counts them among what is to be seen.
vtkSmartPointer<vtkPoints> points_of(const std::vector<Eigen::Vector3f>& places,
                                     const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::vector<char> used(places.size(), 0);
  for (const auto& triangle : triangles)
    for (const auto corner : triangle) used[corner] = 1;
  auto points = vtkSmartPointer<vtkPoints>::New();
  for (std::size_t i = 0; i < places.size(); ++i)
    points->InsertNextPoint(places[used[i] != 0 ? i : triangles.front()[0]].data());
  return points;
}

/// By primitive.
std::map<std::int32_t, const FaceTexture*> images_of(const Textures* textures) {
  std::map<std::int32_t, const FaceTexture*> images;
  if (textures != nullptr)
    for (const auto& face : textures->faces)
      if (face.primitive >= 0) images[face.primitive] = &face;
  return images;
}

/// The triangles of a mesh, sorted into those that are drawn with an image and the rest.
struct Sorted {
  vtkNew<vtkCellArray> plain;
  vtkNew<vtkUnsignedCharArray> colours;                            ///< per plain triangle
  std::map<std::int32_t, vtkSmartPointer<vtkCellArray>> textured;  ///< by primitive
  std::vector<std::array<std::uint32_t, 3>> drawn;                 ///< all of them
  Mesh outlined;                                                   ///< what has outlines: all but objects
};

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

namespace {

void sort_triangles(const Mesh& mesh, const Drawing::MeshStyle& style,
                    const std::map<std::int32_t, const FaceTexture*>& images, std::set<SurfaceClass>& classes,
                    Sorted& sorted) {
  sorted.colours->SetNumberOfComponents(3);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto surface = mesh.classes.empty() ? SurfaceClass::object : mesh.classes[t];
    if (!style.ceilings && surface == SurfaceClass::ceiling) continue;
    const auto primitive = mesh.primitives.empty() ? -1 : mesh.primitives[t];
    const auto& [a, b, c] = mesh.triangles[t];
    sorted.drawn.push_back(mesh.triangles[t]);
    if (images.contains(primitive)) {
      auto& cells = sorted.textured[primitive];
      if (!cells) cells = vtkSmartPointer<vtkCellArray>::New();
      cells->InsertNextCell({a, b, c});
    } else {
      sorted.plain->InsertNextCell({a, b, c});
      sorted.colours->InsertNextTypedTuple(class_colour(surface).data());
      if (!style.vertex_colours && !mesh.classes.empty()) classes.insert(surface);
    }
    if (surface == SurfaceClass::object) continue;
    sorted.outlined.triangles.push_back(mesh.triangles[t]);
    sorted.outlined.primitives.push_back(primitive);
  }
}

void add_outline(vtkRenderer& renderer, vtkPoints* points, const Mesh& mesh, double width) {
  vtkNew<vtkCellArray> lines;
  for (const auto& [a, b] : outline_edges(mesh)) lines->InsertNextCell({a, b});
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(lines);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.15, 0.15, 0.15);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width));
  actor->GetProperty()->LightingOff();
  renderer.AddActor(actor);
}

}  // namespace

void Drawing::add_mesh(const Mesh& mesh, const MeshStyle& style, const Textures* textures) {
  if (mesh.triangles.empty()) return;
  const Eigen::Vector3d shift = impl_->offset(mesh.origin);
  std::vector<Eigen::Vector3f> places;
  places.reserve(mesh.vertices.size());
  for (const auto& v : mesh.vertices) places.push_back(impl_->place(v, shift));
  const auto images = images_of(textures);
  Sorted sorted;
  sort_triangles(mesh, style, images, impl_->classes, sorted);
  if (sorted.drawn.empty()) return;
  impl_->box.extend(drawn_box(places, sorted.drawn));
  const auto points = points_of(places, sorted.drawn);

  const auto add = [&](vtkCellArray* cells) {
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(points);
    data->SetPolys(cells);
    impl_->meshes.push_back(data);
    return data;
  };
  for (const auto& [primitive, cells] : sorted.textured) {
    const auto data = add(cells);
    data->GetPointData()->SetTCoords(places_on(*images.at(primitive), mesh, mesh.origin - textures->origin));
    auto* actor = impl_->add(data, false);
    actor->SetTexture(texture_of(*images.at(primitive)));
    style_surface(actor, true);
    actor->GetProperty()->SetBackfaceCulling(style.inside ? 1 : 0);
  }
  if (sorted.plain->GetNumberOfCells() > 0) {
    const auto data = add(sorted.plain);
    const bool by_vertex = style.vertex_colours && !mesh.colours.empty();
    if (by_vertex) {
      sorted.colours->Reset();
      for (const auto& c : mesh.colours) sorted.colours->InsertNextTypedTuple(c.data());
      data->GetPointData()->SetScalars(sorted.colours);
    } else {
      data->GetCellData()->SetScalars(sorted.colours);
    }
    auto* actor = impl_->add(data, !by_vertex);
    style_surface(actor, false);
    actor->GetProperty()->SetBackfaceCulling(style.inside ? 1 : 0);
  }
  if (style.edges) add_outline(*impl_->renderer, points, sorted.outlined, style.line_width);
}

}  // namespace atrium::render
