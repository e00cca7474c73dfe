#include "modules/io/gltf_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "graph/api/text.hpp"

namespace atrium::io {
namespace {

/// `count` numbers at a key.
std::vector<double> gltf_list(const JsonField& field, const char* key, std::size_t count) {
  const JsonField list = field[key];
  if (list.size() != count) list.fail(fmt::format("has {}, not {}", counted(list.size(), "number"), count));
  std::vector<double> numbers;
  for (const auto& item : list.items()) numbers.push_back(item.number());
  return numbers;
}

/// A node's `matrix` (column after column), or its translation · rotation · scale.
Eigen::Affine3d transform_of(const JsonField& node) {
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (node.has("matrix")) {
    const auto m = gltf_list(node, "matrix", 16);
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
      node["matrix"].fail("does not end with a row 0 0 0 1: perspective is not read");
    for (std::size_t i = 0; i < 16; ++i)
      if (i % 4 != 3) transform.matrix()(static_cast<int>(i % 4), static_cast<int>(i / 4)) = m[i];
    return transform;
  }
  if (node.has("translation")) {
    const auto t = gltf_list(node, "translation", 3);
    transform.translate(Eigen::Vector3d(t[0], t[1], t[2]));
  }
  if (node.has("rotation")) {
    const auto q = gltf_list(node, "rotation", 4);
    const Eigen::Quaterniond turn(q[3], q[0], q[1], q[2]);
    if (!(turn.norm() > 0.5 && turn.norm() < 2))
      node["rotation"].fail("is no rotation: a quaternion x, y, z, w has length 1");
    transform.rotate(turn.normalized());
  }
  if (node.has("scale")) {
    const auto s = gltf_list(node, "scale", 3);
    transform.scale(Eigen::Vector3d(s[0], s[1], s[2]));
  }
  return transform;
}

class SceneWalk {
 public:
  SceneWalk(const GltfFile& file, const Context& context)
      : file_(file), context_(context), root_(file.root()), nodes_(root_.has("nodes") ? root_["nodes"].size() : 0) {
    seen_.resize(nodes_);
  }

  std::vector<GltfPlacement> run() {
    if (root_.has("scenes") && root_["scenes"].size() > 0) {
      read_scene();
    } else {
      const std::vector<char> children = are_children();
      for (std::size_t n = nodes_; n-- > 0;)
        if (children[n] == 0) enter(n, Eigen::Affine3d::Identity(), root_["nodes"].at(n));
      walk();
    }
    if (placed_.empty() && nodes_ == 0 && root_.has("meshes"))
      for (const auto& mesh : root_["meshes"].items()) placed_.push_back({mesh, mesh, Eigen::Affine3d::Identity()});
    if (skins_ > 0)
      context_.warn(
          fmt::format("{}: {} with skins: read without them", file_.path(), counted(skins_, "mesh", "meshes")));
    if (instanced_ > 0)
      context_.warn(fmt::format("{}: {} EXT_mesh_gpu_instancing: each mesh is read once", file_.path(),
                                counted(instanced_, "node has", "nodes have")));
    return std::move(placed_);
  }

 private:
  struct Open {
    std::size_t node;
    Eigen::Affine3d parent;
  };

  void read_scene() {
    const std::uint64_t chosen = root_.natural("scene", 0);
    const std::size_t count = root_["scenes"].size();
    if (chosen >= count) root_["scene"].fail(fmt::format("is {}, but the file has {} scenes", chosen, count));
    if (count > 1)
      context_.warn(fmt::format("{}: of {} scenes, only that which it shows first is read: scenes[{}]", file_.path(),
                                count, chosen));
    const JsonField scene = root_["scenes"].at(static_cast<std::size_t>(chosen));
    if (!scene.has("nodes")) return;
    for (std::size_t i = scene["nodes"].size(); i-- > 0;)
      enter(index_of(scene["nodes"].at(i)), Eigen::Affine3d::Identity(), scene["nodes"].at(i));
    walk();
  }

  std::size_t index_of(const JsonField& field) const {
    const double value = field.number();
    if (!(value >= 0 && value < static_cast<double>(nodes_)) || value != std::floor(value))
      field.fail(fmt::format("is {}, but the file has {} nodes", value, nodes_));
    return static_cast<std::size_t>(value);
  }

  std::vector<char> are_children() const {
    std::vector<char> children(nodes_, 0);
    for (std::size_t n = 0; n < nodes_; ++n)
      if (const JsonField node = root_["nodes"].at(n); node.has("children"))
        for (const auto& child : node["children"].items()) children[index_of(child)] = 1;
    if (nodes_ > 0 && std::find(children.begin(), children.end(), 0) == children.end())
      root_["nodes"].fail("go round: each is a child of another");
    return children;
  }

  void enter(std::size_t node, const Eigen::Affine3d& parent, const JsonField& from) {
    if (seen_[node] != 0)
      from.fail(fmt::format("is node {}, which is reached a second time: nodes form trees, without cycles", node));
    seen_[node] = 1;
    open_.push_back({node, parent});
  }

  void walk() {
    while (!open_.empty()) {
      const Open at = open_.back();
      open_.pop_back();
      const JsonField node = root_["nodes"].at(at.node);
      const Eigen::Affine3d here = at.parent * transform_of(node);
      if (!here.matrix().allFinite()) node.fail("has a transform that is not finite");
      if (node.has("mesh")) placed_.push_back({node, file_.entry("meshes", node, "mesh"), here});
      skins_ += node.has("skin") ? 1 : 0;
      instanced_ += node.has("extensions") && node["extensions"].has("EXT_mesh_gpu_instancing") ? 1 : 0;
      if (!node.has("children")) continue;
      for (std::size_t i = node["children"].size(); i-- > 0;)
        enter(index_of(node["children"].at(i)), here, node["children"].at(i));
    }
  }

  const GltfFile& file_;
  const Context& context_;
  JsonField root_;
  std::size_t nodes_;
  std::vector<char> seen_;
  std::vector<Open> open_;
  std::vector<GltfPlacement> placed_;
  std::size_t skins_ = 0, instanced_ = 0;
};

}  // namespace

std::vector<GltfPlacement> gltf_placements(const GltfFile& file, const Context& context) {
  return SceneWalk(file, context).run();
}

void refuse_gltf_extensions(const GltfFile& file) {
  if (!file.root().has("extensionsRequired")) return;
  for (const auto& item : file.root()["extensionsRequired"].items()) {
    const std::string name = item.text();
    if (name == "KHR_draco_mesh_compression" || name == "EXT_meshopt_compression" || name == "KHR_meshopt_compression")
      item.fail(fmt::format("is {}: the mesh is compressed, which is not read", name),
                "export it without compression, or unpack it: gltf-transform cp in.glb out.glb; Blender opens and "
                "exports it as well");
    const bool fine = name.starts_with("KHR_materials_") || name.starts_with("KHR_texture_") ||
                      name == "EXT_texture_webp" || name == "KHR_mesh_quantization" || name == "KHR_lights_punctual" ||
                      name == "KHR_xmp_json_ld" || name == "KHR_animation_pointer" || name == "KHR_node_visibility";
    if (!fine)
      item.fail(fmt::format("is {}, without which the file must not be shown, and which is not read", name),
                "export it without that extension");
  }
}

}  // namespace atrium::io
