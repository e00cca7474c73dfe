#include "modules/io/glb_buffer.hpp"

#include <tiny_gltf.h>

#include <limits>

#include "graph/api/error.hpp"

namespace atrium::io {
namespace {

constexpr int array = TINYGLTF_TARGET_ARRAY_BUFFER, real = TINYGLTF_COMPONENT_TYPE_FLOAT;

std::size_t padded(std::size_t size) { return (size + 3) / 4 * 4; }

}  // namespace

int GlbBuffer::make_view(tinygltf::Model& model, View& view) {
  if (view.index < 0) {
    view.index = static_cast<int>(model.bufferViews.size());
    model.bufferViews.emplace_back();
    model.bufferViews.back().buffer = 0;
  }
  return view.index;
}

int GlbBuffer::add(tinygltf::Model& model, View& view, const Kind& kind, const void* data, std::size_t count) {
  auto& properties = model.bufferViews[make_view(model, view)];
  properties.target = kind.target;
  if (kind.target == array) properties.byteStride = kind.size;
  tinygltf::Accessor accessor;
  accessor.bufferView = view.index;
  accessor.byteOffset = view.bytes.size();
  accessor.componentType = kind.component;
  accessor.type = kind.type;
  accessor.count = count;
  const auto* first = static_cast<const std::uint8_t*>(data);
  view.bytes.insert(view.bytes.end(), first, first + count * kind.size);
  model.accessors.push_back(std::move(accessor));
  return static_cast<int>(model.accessors.size()) - 1;
}

int GlbBuffer::indices(tinygltf::Model& model, const std::vector<std::uint32_t>& values) {
  const Kind kind{TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, 4};
  return add(model, indices_, kind, values.data(), values.size());
}

int GlbBuffer::positions(tinygltf::Model& model, const std::vector<Eigen::Vector3f>& values) {
  const int index = add(model, positions_, {array, real, TINYGLTF_TYPE_VEC3, 12}, values.data(), values.size());
  Eigen::Array3f low = values.front(), high = values.front();
  for (const auto& v : values) {
    low = low.min(v.array());
    high = high.max(v.array());
  }
  model.accessors[index].minValues = {low[0], low[1], low[2]};
  model.accessors[index].maxValues = {high[0], high[1], high[2]};
  return index;
}

int GlbBuffer::vectors(tinygltf::Model& model, const std::vector<Eigen::Vector3f>& values) {
  return add(model, vectors_, {array, real, TINYGLTF_TYPE_VEC3, 12}, values.data(), values.size());
}

int GlbBuffer::places(tinygltf::Model& model, const std::vector<Eigen::Vector2f>& values) {
  return add(model, places_, {array, real, TINYGLTF_TYPE_VEC2, 8}, values.data(), values.size());
}

int GlbBuffer::colours(tinygltf::Model& model, const std::vector<std::array<std::uint16_t, 4>>& values) {
  const Kind kind{array, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC4, 8};
  const int index = add(model, colours_, kind, values.data(), values.size());
  model.accessors[index].normalized = true;
  return index;
}

int GlbBuffer::image(tinygltf::Model& model, const std::vector<std::uint8_t>& bytes) {
  images_.push_back({-1, bytes});
  return make_view(model, images_.back());
}

void GlbBuffer::finish(tinygltf::Model& model) {
  std::vector<View*> views{&positions_, &vectors_, &places_, &colours_, &indices_};
  for (auto& image : images_) views.push_back(&image);
  std::size_t size = 0;
  for (const auto* view : views) size += padded(view->bytes.size());
  if (size == 0) return;
  if (size > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw Error("the mesh and its textures are larger than the 2 GiB that a .glb file can have here",
                "write it as .ply, or make coarser textures");
  model.buffers.emplace_back();
  auto& bytes = model.buffers[0].data;
  bytes.reserve(size);
  for (auto* view : views) {
    if (view->index < 0) continue;
    model.bufferViews[view->index].byteOffset = bytes.size();
    model.bufferViews[view->index].byteLength = view->bytes.size();
    bytes.insert(bytes.end(), view->bytes.begin(), view->bytes.end());
    bytes.resize(padded(bytes.size()));
    view->bytes = {};
  }
}

}  // namespace atrium::io
