// A plugin whose node type belongs to another module.
#include "graph/api/plugin.hpp"
#include "tests/graph/test_nodes.hpp"
ATRIUM_PLUGIN(atrium::test::Make)
