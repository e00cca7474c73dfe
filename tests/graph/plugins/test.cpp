// A plugin that is in order: the module "test".
#include "graph/api/plugin.hpp"
#include "tests/graph/test_nodes.hpp"
ATRIUM_PLUGIN(atrium::test::Make, atrium::test::Read, atrium::test::Find, atrium::test::Write)
