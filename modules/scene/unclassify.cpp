#include "modules/scene/unclassify.hpp"

namespace atrium::scene {

Unclassify::Out Unclassify::run(const In& in) {
  Out out{*in.mesh};
  out.mesh.classes.clear();
  out.mesh.storeys.clear();
  out.mesh.primitives.clear();
  return out;
}

}  // namespace atrium::scene
