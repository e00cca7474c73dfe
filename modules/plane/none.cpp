#include "modules/plane/none.hpp"

namespace atrium::plane {

None::Out None::run(const In& in, const Params& /*params*/, Context& /*context*/) { return {in.planes}; }

}  // namespace atrium::plane
