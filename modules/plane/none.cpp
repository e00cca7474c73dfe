#include "modules/plane/none.hpp"

namespace atrium::plane {

None::Out None::run(const In& in) { return {in.planes}; }

}  // namespace atrium::plane
