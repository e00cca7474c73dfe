#include "modules/object/none.hpp"

namespace atrium::object {

None::Out None::run(const In& in, const Params& /*params*/, Context& /*context*/) {
  Out out;
  out.mesh.origin = in.cloud->origin;
  return out;
}

}  // namespace atrium::object
