# Installs the build, then lives outside of the tree: builds a plugin against the installed package, runs it, adds a node to
# it by one pair of files and one word, runs that, and offers a plugin of another framework.
#   cmake -DBUILD=<build folder> -DWORK=<scratch folder> -DLAUNCHER=<ccache or nothing> -P install_test.cmake
set(here ${CMAKE_CURRENT_LIST_DIR})
set(prefix ${WORK}/prefix)
set(program ${prefix}/bin/atrium)
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})

# call(<expected exit code> <text that stdout and stderr must hold> <command>...)
function(call code text)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${WORK} RESULT_VARIABLE result OUTPUT_VARIABLE output
                  ERROR_VARIABLE output)
  if(NOT result STREQUAL code OR NOT output MATCHES "${text}")
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nreturned ${result}, expected ${code} with \"${text}\":\n${output}")
  endif()
endfunction()
function(build source)
  cmake_path(GET source FILENAME name)
  call(0 "" ${CMAKE_COMMAND} -S ${source} -B ${WORK}/build-${name} -DCMAKE_PREFIX_PATH=${prefix}
       -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
  call(0 "" ${CMAKE_COMMAND} --build ${WORK}/build-${name})
endfunction()

unset(ENV{ATRIUM_PLUGIN_PATH})
call(0 "" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
call(0 "align.none" ${program} nodes align.none)
foreach(file include/atrium/graph/api/node.hpp include/atrium/modules/types/cloud.hpp share/atrium/pipelines/paper.yaml
             share/atrium/colormaps/viridis.txt share/atrium/schema/pipeline.schema.json share/atrium/LICENSE share/atrium/doc/licences.md
             share/doc/atrium/copyright share/man/man1/atrium.1.gz share/bash-completion/completions/atrium)
  if(NOT EXISTS ${prefix}/${file})
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()

# Each installed header compiles alone.
file(GLOB_RECURSE headers ${prefix}/include/atrium/graph/*.hpp ${prefix}/include/atrium/modules/*.hpp)
list(FILTER headers EXCLUDE REGEX "/modules/pcl/")  # needs PCL: the tutorial's plugin compiles it
list(LENGTH headers count)
if(count LESS 20)
  message(FATAL_ERROR "only ${count} headers are installed")
endif()
list(JOIN headers "\n" lines)
file(WRITE ${WORK}/headers.txt "${lines}\n")
cmake_host_system_information(RESULT cores QUERY NUMBER_OF_LOGICAL_CORES)
call(0 "" xargs -a ${WORK}/headers.txt -P ${cores} -n 1
     c++ -std=c++20 -fsyntax-only -w -x c++ -I${prefix}/include/atrium -I/usr/include/eigen3)

# What is installed is as good on another machine.
get_filename_component(source ${here}/../.. ABSOLUTE)
execute_process(COMMAND grep -rlF -e ${BUILD}/ -e ${source}/graph/ -e ${source}/modules/ ${prefix} OUTPUT_VARIABLE files)
if(files)
  message(FATAL_ERROR "paths of the build are in installed files:\n${files}")
endif()

# A pipeline is found by its name, from here as from any folder.
call(0 "ok: " ${program} check atrium.yaml -s scan=${prefix}/share/atrium/LICENSE)
call(0 "" ${program} run ${here}/picture.yaml --out ${WORK}/run-picture)

file(COPY ${here}/example_plugin DESTINATION ${WORK})
build(${WORK}/example_plugin)
set(ENV{ATRIUM_PLUGIN_PATH} ${WORK}/build-example_plugin/lib/atrium)
call(0 "points +125" ${program} run ${here}/one_node.yaml --out ${WORK}/run-one)
call(3 "example.extent" ${program} run ${here}/two_nodes.yaml --out ${WORK}/run-two)

file(COPY ${here}/second_node/ DESTINATION ${WORK}/example_plugin)
file(READ ${WORK}/example_plugin/CMakeLists.txt text)
string(REPLACE "NODES lattice" "NODES lattice extent" text "${text}")
file(WRITE ${WORK}/example_plugin/CMakeLists.txt "${text}")
build(${WORK}/example_plugin)
call(0 "extent.z +0.8 +m" ${program} run ${here}/two_nodes.yaml --out ${WORK}/run-two)

file(COPY ${here}/wrong_plugin DESTINATION ${WORK})
build(${WORK}/wrong_plugin)
set(ENV{ATRIUM_PLUGIN_PATH} ${WORK}/build-wrong_plugin)
call(5 "another framework.*rebuild it" ${program} run ${here}/wrong.yaml --out ${WORK}/run-wrong)
if(EXISTS ${WORK}/run-wrong)
  message(FATAL_ERROR "a run that could not begin has made its folder")
endif()

call(0 "" ${CMAKE_COMMAND} --install ${WORK}/build-example_plugin --prefix ${prefix})
unset(ENV{ATRIUM_PLUGIN_PATH})
call(0 "points +125" ${program} run ${here}/one_node.yaml --out ${WORK}/run-installed)

# The tutorial: its files are those that stand here, and they do what it says.
file(READ ${source}/share/doc/tutorial.md page)
file(GLOB files ${here}/tutorial/*)
foreach(file IN LISTS files)
  file(READ ${file} text)
  string(FIND "${page}" "\n${text}```" place)
  if(place EQUAL -1)
    message(FATAL_ERROR "share/doc/tutorial.md does not hold ${file} as it is")
  endif()
endforeach()
file(COPY ${here}/tutorial DESTINATION ${WORK})
build(${WORK}/tutorial)
set(ENV{ATRIUM_PLUGIN_PATH} ${WORK}/build-tutorial/lib/atrium)
call(0 "Points this near are around a point" ${program} nodes mine.smooth)
call(0 "cloud_to_mesh.median" ${program} run ${WORK}/tutorial/smooth.yaml --out ${WORK}/run-smooth)
call(0 "cloud_to_mesh.median" ${program} run ${WORK}/tutorial/smooth.yaml -s smooth.type=filter.none --out ${WORK}/run-raw)
call(0 "20 cm" ${program} sweep run ${WORK}/tutorial/radius.yaml --out ${WORK}/run-radius)
call(0 "" ${program} report ${WORK}/run-radius)
file(REMOVE_RECURSE ${WORK})
