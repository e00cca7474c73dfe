# `cpack` in the build folder makes two Debian packages: atrium (the program, its plugins, pipelines and documentation) and
# atrium-dev (what third parties build plugins with). Configure with -DCMAKE_INSTALL_PREFIX=/usr, so that libraries go where
# Debian has them.
# Whoever builds packages answers for them: they name the builder, as Debian's own tools do.
if(NOT DEFINED ATRIUM_MAINTAINER)
  set(name $ENV{DEBFULLNAME})
  set(mail $ENV{DEBEMAIL})
  if(NOT mail)
    cmake_host_system_information(RESULT host QUERY FQDN)
    execute_process(COMMAND id -un OUTPUT_VARIABLE user OUTPUT_STRIP_TRAILING_WHITESPACE)
    set(mail ${user}@${host})
  endif()
  if(NOT name)
    set(name "Local build of Atrium")
  endif()
  set(ATRIUM_MAINTAINER "${name} <${mail}>" CACHE STRING "Whom the packages name: NAME <MAIL>; from DEBFULLNAME and DEBEMAIL")
endif()
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME atrium)
set(CPACK_PACKAGE_CONTACT ${ATRIUM_MAINTAINER})
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
                                                WORLD_EXECUTE)

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME atrium)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR}/lib ${CMAKE_BINARY_DIR}/lib/atrium)
# What OpenGL loads by name to draw without a display; no library of ours is linked with it.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS "libegl-mesa0, libgl1-mesa-dri")
# Plans as PDF show the names of rooms; fontconfig, which the libraries for that need, comes with a font for Latin, Greek and Cyrillic.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "bash-completion, fonts-noto-core, fonts-noto-cjk")
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "light planar models of buildings from indoor point clouds
Atrium turns raw indoor point clouds (LiDAR, RGB-D, phone scans, simulated)
into light planar models of the building: walls, floors and ceilings as a few
large polygons with doors and windows, a floor plan, furniture as a mesh.
Each algorithm is a node of a dataflow graph that a declarative file wires.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME atrium-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "atrium (= ${PROJECT_VERSION}), libeigen3-dev, libfmt-dev, libboost-dev, libboost-graph-dev, nlohmann-json3-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "files to build plugins for Atrium with
Atrium turns raw indoor point clouds into light planar models of the building.

This package has the headers and the CMake package with which node types are
built outside of Atrium's own tree: find_package(atrium).")

# The manual page and the completion are printed by the program from the tables of its command line.
set(made ${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_DATADIR}/atrium-made)
set(completion ${PROJECT_SOURCE_DIR}/share/packages/completion.bash)
file(MAKE_DIRECTORY ${made})
add_custom_command(OUTPUT ${made}/atrium.1 ${made}/atrium.1.gz ${made}/atrium
                   COMMAND atrium generate man > ${made}/atrium.1
                   COMMAND gzip -9nc ${made}/atrium.1 > ${made}/atrium.1.gz
                   COMMAND atrium generate bash-completion > ${made}/atrium.table
                   COMMAND cat ${completion} ${made}/atrium.table > ${made}/atrium
                   DEPENDS atrium ${completion} COMMENT "Printing the manual page and the completion" VERBATIM)
add_custom_target(manual ALL DEPENDS ${made}/atrium.1.gz ${made}/atrium)
install(FILES ${made}/atrium.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${made}/atrium DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)

install(FILES ${PROJECT_SOURCE_DIR}/share/packages/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/atrium)
install(FILES ${PROJECT_SOURCE_DIR}/share/packages/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/atrium-dev
        COMPONENT development)
include(CPack)
