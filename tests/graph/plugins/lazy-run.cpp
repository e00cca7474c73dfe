// The functions of the module "lazy".
#include "graph/api/plugin.hpp"
#include "tests/graph/plugins/lazy_nodes.hpp"

atrium::lazy::Double::Out atrium::lazy::Double::run(const In& /*in*/, const Params& params, Context& /*context*/) {
  return {2 * params.number};
}
ATRIUM_PLUGIN(atrium::lazy::Double)
