#include "graph/pipeline/pipeline.hpp"
// Until the pipeline writer is there.
__attribute__((weak)) std::string atrium::resolved_yaml(const Pipeline& /*pipeline*/) { return "atrium: 1\n"; }
