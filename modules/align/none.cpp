#include "modules/align/none.hpp"

namespace atrium::align {

None::Out None::run(const In& in, const Params& /*params*/, Context& /*context*/) {
  return {in.planes, in.transform ? *in.transform : Transform{}};
}

}  // namespace atrium::align
