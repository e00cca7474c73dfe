#include "modules/scene/bake_textures.hpp"

#include <fmt/format.h>

#include <utility>

#include "modules/scene/texture_frames.hpp"
#include "modules/scene/texture_painting.hpp"
#include "modules/scene/view_cells.hpp"

namespace atrium::scene {
namespace {

/// For each image the points over it, in ascending order.
std::vector<std::vector<std::uint32_t>> points_over_all(const std::vector<TextureView>& views, const Cloud& cloud,
                                                        const Context& context) {
  constexpr std::size_t chunk_size = 65536;
  using Lists = std::vector<std::vector<std::uint32_t>>;
  const ViewCells cells(views, context);
  std::vector<Lists> chunks((cloud.size() + chunk_size - 1) / chunk_size, Lists(views.size()));
  context.parallel_chunks(cloud.size(), chunk_size, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (const std::uint32_t v : cells.views_at(cloud.points[i]))
        if (is_over(views[v], cloud, i)) chunks[chunk][v].push_back(static_cast<std::uint32_t>(i));
  });
  Lists result(views.size());
  context.parallel_for(
      views.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v)
          for (auto& lists : chunks) {
            const auto list = std::exchange(lists[v], {});
            result[v].insert(result[v].end(), list.begin(), list.end());
          }
      },
      1);
  return result;
}

void check_paintable(const Mesh& mesh) {
  if (mesh.triangles.empty()) return;
  if (mesh.classes.empty() || mesh.primitives.empty())
    throw Error("the mesh does not say which triangles belong to which wall, floor or ceiling",
                "give it the structure of scene.merge, or a .ply that io.write_mesh wrote");
}

}  // namespace

BakeTextures::Out BakeTextures::run(const In& in, const Params& params, Context& context) {
  check_paintable(*in.mesh);
  const Cloud& cloud = *in.cloud;
  Out out;
  out.textures.origin = in.mesh->origin;
  if (cloud.colours.empty()) {
    context.warn("the cloud has no colours: there are no textures");
    return out;
  }
  const TextureSize size{params.resolution, static_cast<double>(params.max_side),
                         static_cast<double>(params.max_pixels)};
  auto images = texture_frames(*in.mesh, size, context);
  std::vector<TextureView> views;
  views.reserve(images.size());
  for (const auto& image : images) views.emplace_back(image, cloud.origin - in.mesh->origin, cloud, params.distance);
  const auto points = points_over_all(views, cloud, context);
  std::vector<char> painted(images.size());
  context.parallel_for(
      images.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) painted[i] = paint(views[i], cloud, points[i], images[i]) ? 1 : 0;
      },
      1);
  for (std::size_t i = 0; i < images.size(); ++i)
    if (painted[i] != 0) out.textures.faces.push_back(std::move(images[i]));
  if (images.empty()) context.warn("the mesh has no walls, floors or ceilings: there are no textures");
  if (const auto lacking = images.size() - out.textures.faces.size(); lacking > 0)
    context.warn(fmt::format("{} of {} faces have no points within {} m: they have no texture", lacking, images.size(),
                             params.distance));
  return out;
}

}  // namespace atrium::scene
