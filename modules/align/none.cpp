#include "modules/align/none.hpp"

namespace atrium::align {

None::Out None::run(const In& in) { return {in.planes, in.transform ? *in.transform : Transform{}}; }

}  // namespace atrium::align
