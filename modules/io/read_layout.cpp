#include "modules/io/read_layout.hpp"

#include "modules/io/json_text.hpp"
#include "modules/io/truth_json.hpp"

namespace atrium::io {
namespace {

GroundTruth read(const JsonField& root, const std::string& path, const Context& context) {
  if (root.has("atrium_truth")) return truth_from_json(root);
  if (root.has("planes")) return truth_from_planes(root, path, context);
  if (root.has("rooms") || root.json().is_array()) return truth_from_rooms(root);
  throw Error(path + ": no layout: it has none of the keys atrium_truth, planes, rooms",
              "io.read_layout documents what it reads");
}

}  // namespace

ReadLayout::Out ReadLayout::run(const In& /*in*/, const Params& params, Context& context) {
  const std::string& path = params.path.path;
  const auto json = parsed_json(path);
  Out out;
  out.truth = read({json, path + ":"}, path, context);
  if (out.truth.rooms.empty()) context.warn(path + ": there is no room in it");
  out.plan = plan_of(out.truth);
  out.mesh = out.truth.mesh;
  return out;
}

}  // namespace atrium::io
