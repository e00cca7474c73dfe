// A plugin of a framework that never was: it must be refused before any of its code but the stamp is called.
#include <cstdlib>

extern "C" const char* atrium_plugin_stamp() { return "atrium 0; another compiler"; }
extern "C" void atrium_plugin_nodes(void* /*nodes*/) { std::abort(); }
