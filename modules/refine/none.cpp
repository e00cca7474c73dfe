#include "modules/refine/none.hpp"

namespace atrium::refine {

None::Out None::run(const In& in) { return {in.meshes}; }

}  // namespace atrium::refine
