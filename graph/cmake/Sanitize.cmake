# ATRIUM_SANITIZE=address|thread: everything is built with that sanitizer, and the first finding ends the program.
if(ATRIUM_SANITIZE AND NOT CMAKE_CXX_COMPILER_ID MATCHES Clang)
  message(FATAL_ERROR "ATRIUM_SANITIZE needs clang: -DCMAKE_CXX_COMPILER=clang++-14")
elseif(ATRIUM_SANITIZE)
  add_compile_options(-fno-omit-frame-pointer -Wno-unknown-warning-option)  # some warnings are GCC's
endif()
if(ATRIUM_SANITIZE STREQUAL "address")
  # Assertions are on: Eigen's sizes and indices, the standard library's.
  set(CMAKE_CXX_FLAGS_RELEASE "-O1 -gline-tables-only -D_GLIBCXX_ASSERTIONS")
  # Without the checks of every pointer: they cost a quarter of the build, and AddressSanitizer sees what they see.
  add_compile_options(-fsanitize=address,undefined -fno-sanitize=vptr,null,alignment,object-size,function -fno-sanitize-recover=all)
  add_link_options(-fsanitize=address,undefined)
elseif(ATRIUM_SANITIZE STREQUAL "thread")
  set(CMAKE_CXX_FLAGS_RELEASE "-O1 -gline-tables-only -DNDEBUG")
  add_compile_options(-fsanitize=thread)
  add_link_options(-fsanitize=thread)
  # Debian's libtbb is not instrumented: the sanitizer would not see what its tasks wait for. See the folder's tbb.hpp.
  include_directories(BEFORE ${PROJECT_SOURCE_DIR}/tests/support/threads)
elseif(ATRIUM_SANITIZE)
  message(FATAL_ERROR "ATRIUM_SANITIZE is address or thread, not ${ATRIUM_SANITIZE}")
endif()
