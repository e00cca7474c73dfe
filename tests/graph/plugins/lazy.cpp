// The tables of the module "lazy".
#include "graph/api/plugin.hpp"
#include "tests/graph/plugins/lazy_nodes.hpp"
ATRIUM_LAZY_PLUGIN(atrium::lazy::Double, atrium::lazy::Forgotten)
