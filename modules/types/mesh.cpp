#include "modules/types/mesh.hpp"

namespace atrium {

Mesh transformed(const Mesh& mesh, const Transform& transform) {
  Mesh result = mesh;
  result.origin = transform.rotation * mesh.origin + transform.translation;
  for (auto& v : result.vertices) v = transform.rotation * v;
  return result;
}

}  // namespace atrium
