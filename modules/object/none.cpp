#include "modules/object/none.hpp"

namespace atrium::object {

None::Out None::run() { return {}; }

}  // namespace atrium::object
