find_package(rapidcheck REQUIRED)
list(APPEND libraries rapidcheck nlohmann_json::nlohmann_json atrium_why)
# Plugins, good and bad, for the tests of the registry and the command line.
foreach(plugin test stranger misnamed empty lazy lazy-run)
  add_library(test_plugin_${plugin} MODULE ${CMAKE_CURRENT_SOURCE_DIR}/graph/plugins/${plugin}.cpp)
  target_link_libraries(test_plugin_${plugin} PRIVATE atrium::graph)
  set_target_properties(test_plugin_${plugin} PROPERTIES OUTPUT_NAME atrium_${plugin}
                        LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests/plugins)
endforeach()
