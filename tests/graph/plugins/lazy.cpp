// The tables of the module "lazy", and what needs no second library.
#include "graph/api/plugin.hpp"
#include "tests/graph/plugins/lazy_nodes.hpp"

atrium::lazy::Light::Out atrium::lazy::Light::run(const In& /*in*/, const Params& /*params*/, Context& /*context*/) {
  return {1};
}
using atrium::detail::Types;
ATRIUM_LAZY_PLUGIN(Types<atrium::lazy::Double, atrium::lazy::Forgotten>{}, Types<atrium::lazy::Light>{})
