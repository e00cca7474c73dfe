#include "modules/scene/bake_textures.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "modules/scene/texture_frames.hpp"
#include "modules/scene/texture_painting.hpp"

namespace atrium::scene {
namespace {

constexpr std::size_t chunk_size = 65536, block_size = 1024;

/// Whether any place in the box can lie over the image (a test of intervals, so some others pass, too).
bool may_be_over(const TextureView& view, const Eigen::AlignedBox3f& box) {
  const Eigen::Vector3f centre = box.center(), half = box.sizes() / 2;
  const auto meets = [&](float value, const Eigen::Vector3f& axis, float low, float high) {
    const float slack = axis.cwiseAbs().dot(half) * 1.001F + 1e-3F * (high - low);
    return value + slack >= low && value - slack <= high;
  };
  return meets(view.height(centre), view.normal, -view.distance, view.reach) &&
         meets(view.column(centre), view.across, 0, static_cast<float>(view.width)) &&
         meets(view.row(centre), view.down, 0, static_cast<float>(view.tall));
}

/// For each image the points over it, in ascending order.
std::vector<std::vector<std::uint32_t>> points_over_all(const std::vector<TextureView>& views, const Cloud& cloud,
                                                        const Context& context) {
  using Lists = std::vector<std::vector<std::uint32_t>>;
  std::vector<Lists> chunks((cloud.size() + chunk_size - 1) / chunk_size, Lists(views.size()));
  context.parallel_chunks(cloud.size(), chunk_size, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    for (std::size_t first = begin; first < end; first += block_size) {
      const std::size_t last = std::min(first + block_size, end);
      Eigen::AlignedBox3f box;
      for (std::size_t i = first; i < last; ++i) box.extend(cloud.points[i]);
      for (std::size_t v = 0; v < views.size(); ++v)
        if (may_be_over(views[v], box)) points_over(views[v], cloud, first, last, chunks[chunk][v]);
    }
  });
  Lists result(views.size());
  context.parallel_for(
      views.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v)
          for (auto& lists : chunks) result[v].insert(result[v].end(), lists[v].begin(), lists[v].end());
      },
      1);
  return result;
}

void check(const Mesh& mesh) {
  if (mesh.triangles.empty()) return;
  if (mesh.classes.empty() || mesh.primitives.empty())
    throw Error("the mesh does not say which triangles belong to which wall, floor or ceiling",
                "give it the structure of scene.merge, or a .ply that io.write_mesh wrote");
}

}  // namespace

BakeTextures::Out BakeTextures::run(const In& in, const Params& params, Context& context) {
  check(*in.mesh);
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
