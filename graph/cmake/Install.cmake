# What `cmake --install` puts where: the program, the libraries, their headers, the CMake package that third parties build
# plugins with, the pipelines and the files of share/ that they use. Plugins are installed by atrium_add_plugin().
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/atrium)
set(header_dir ${CMAKE_INSTALL_INCLUDEDIR}/atrium)

install(TARGETS atrium_graph atrium_types atrium_geometry EXPORT atriumTargets
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS atrium RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
foreach(folder graph/api graph/cache graph/pipeline graph/run modules/types modules/geometry)
  get_filename_component(parent ${folder} DIRECTORY)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION ${header_dir}/${parent} COMPONENT development
          FILES_MATCHING PATTERN "*.hpp")
endforeach()
# For third parties' nodes around PCL (share/doc/tutorial.md).
install(FILES ${PROJECT_SOURCE_DIR}/modules/pcl/pcl_cloud.hpp DESTINATION ${header_dir}/modules/pcl COMPONENT development)

install(EXPORT atriumTargets NAMESPACE atrium:: DESTINATION ${package_dir} COMPONENT development)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/atriumConfig.cmake.in ${PROJECT_BINARY_DIR}/atriumConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
# Plugins are checked by a stamp when they are loaded; the package promises no more than that.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/atriumConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/atriumConfig.cmake ${PROJECT_BINARY_DIR}/atriumConfigVersion.cmake
              ${PROJECT_SOURCE_DIR}/graph/cmake/AtriumPlugin.cmake ${PROJECT_SOURCE_DIR}/graph/cmake/plugin.cpp.in
        DESTINATION ${package_dir} COMPONENT development)

# Pipelines are found by name beside the library: here as where it is installed.
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_DATADIR}/atrium)
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/pipelines ${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_DATADIR}/atrium/pipelines SYMBOLIC)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/pipelines DESTINATION ${CMAKE_INSTALL_DATADIR}/atrium)
install(FILES ${PROJECT_SOURCE_DIR}/share/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/atrium)
# Not the scripts that set up, build and try a checkout.
foreach(folder colormaps doc schema)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/share/${folder} DESTINATION ${CMAKE_INSTALL_DATADIR}/atrium)
endforeach()
