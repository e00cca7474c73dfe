// A plugin that was built for another framework.
#include <vector>
namespace atrium {
struct NodeType;
}
extern "C" const char* atrium_plugin_stamp() { return "atrium 0; some other compiler"; }
extern "C" void atrium_plugin_nodes(std::vector<atrium::NodeType>& /*nodes*/) {}
