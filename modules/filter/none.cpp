#include "modules/filter/none.hpp"

namespace atrium::filter {

None::Out None::run(const In& in) { return {in.cloud}; }

}  // namespace atrium::filter
