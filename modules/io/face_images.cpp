#include "modules/io/face_images.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "graph/api/error.hpp"
#include "modules/io/obj_groups.hpp"
#include "modules/io/png_encoder.hpp"

namespace atrium::io {
namespace {

void check(const FaceTexture& face) {
  const bool sound = face.corner.allFinite() && face.across.allFinite() && face.down.allFinite() &&
                     face.across.norm() > 0 && face.down.norm() > 0;
  if (!sound) throw Error(fmt::format("the texture of primitive {} has no rectangle in space", face.primitive));
}

/// The primitives of the mesh's structure and the class of each (of its first triangle).
std::map<std::int32_t, SurfaceClass> structural_primitives(const Mesh& mesh) {
  std::map<std::int32_t, SurfaceClass> result;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (!mesh.classes.empty() && !mesh.primitives.empty() && mesh.classes[t] != SurfaceClass::object)
      result.emplace(mesh.primitives[t], mesh.classes[t]);
  return result;
}

}  // namespace

FaceImages::FaceImages(const Textures& textures, const Mesh& mesh, const Context& context) {
  const auto wanted = structural_primitives(mesh);
  std::vector<const FaceTexture*> faces;
  for (const auto& face : textures.faces)
    if (wanted.contains(face.primitive)) faces.push_back(&face);
  std::stable_sort(faces.begin(), faces.end(), [](auto* a, auto* b) { return a->primitive < b->primitive; });
  for (const auto* face : faces) {
    check(*face);
    if (!images_.empty() && images_.back().primitive == face->primitive)
      throw Error(fmt::format("primitive {} has two textures", face->primitive));
    images_.push_back({face->primitive,
                       group_name(wanted.at(face->primitive), face->primitive),
                       textures.origin - mesh.origin + face->corner,
                       face->across / face->across.squaredNorm(),
                       face->down / face->down.squaredNorm(),
                       {}});
  }
  context.parallel_for(
      faces.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          images_[i].png = encode_png(faces[i]->width, faces[i]->height, faces[i]->pixels);
      },
      1);
}

std::size_t FaceImages::find(SurfaceClass surface, std::int32_t primitive) const {
  if (surface == SurfaceClass::object) return none;
  const auto found = std::lower_bound(images_.begin(), images_.end(), primitive,
                                      [](const Image& image, std::int32_t p) { return image.primitive < p; });
  if (found == images_.end() || found->primitive != primitive) return none;
  return static_cast<std::size_t>(found - images_.begin());
}

Eigen::Vector2d FaceImages::place(std::size_t image, const Eigen::Vector3d& vertex) const {
  const Eigen::Vector3d from = vertex - images_[image].corner;
  return {images_[image].across.dot(from), images_[image].down.dot(from)};
}

}  // namespace atrium::io
