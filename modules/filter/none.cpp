#include "modules/filter/none.hpp"

namespace atrium::filter {

None::Out None::run(const In& in, const Params& /*params*/, Context& /*context*/) { return {in.cloud}; }

}  // namespace atrium::filter
