#include "modules/io/read_layout.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "modules/io/paths.hpp"
#include "modules/io/truth_json.hpp"

namespace atrium::io {
namespace {

GroundTruth read(const JsonField& root, const std::string& path, const Context& context) {
  if (root.has("atrium_truth")) return truth_from_json(root);
  if (root.has("planes")) return truth_from_planes(root, path, context);
  if (root.has("rooms") || root.is_list()) return truth_from_rooms(root);
  throw Error(path + ": no layout: it has none of the keys atrium_truth, planes, rooms",
              "io.read_layout documents what it reads");
}

// A mesh or a cloud where the truth is asked for would only be no JSON.
void refuse_geometry(const std::string& path) {
  constexpr std::array<std::string_view, 12> geometry{".ply", ".obj", ".stl", ".glb", ".gltf", ".off",
                                                      ".pcd", ".xyz", ".pts", ".las", ".laz",  ".vg"};
  const std::string extension = extension_of(path);
  if (std::find(geometry.begin(), geometry.end(), extension) == geometry.end()) return;
  throw Error(
      path + ": a layout is JSON, this is a " + extension + " file",
      "give truth.json, a headset's layout.json or a list of room corners; a true mesh is read by io.read_mesh, "
      "and metric.structure takes it as truth_mesh");
}

}  // namespace

ReadLayout::Out ReadLayout::run(const Params& params, Context& context) {
  const std::string& path = params.path.path;
  refuse_geometry(path);
  const JsonFile file(path);
  Out out;
  out.truth = read(file.root(), path, context);
  if (out.truth.rooms.empty()) context.warn(path + ": there is no room in it");
  out.plan = plan_of(out.truth);
  out.mesh = out.truth.mesh;
  return out;
}

}  // namespace atrium::io
