#include "modules/object/none.hpp"

namespace atrium::object {

None::Out None::run(const In& in) {
  Out out;
  out.mesh.origin = in.cloud->origin;
  return out;
}

}  // namespace atrium::object
