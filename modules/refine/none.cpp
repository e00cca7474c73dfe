#include "modules/refine/none.hpp"

namespace atrium::refine {

None::Out None::run(const In& in, const Params& /*params*/, Context& /*context*/) { return {in.meshes}; }

}  // namespace atrium::refine
