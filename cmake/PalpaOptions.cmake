# Language, reproducibility, warnings, speed of the build.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
# Where programs find what they load when it is first needed: built, and installed.
set(PALPA_LOADED_FROM ${PROJECT_BINARY_DIR}/lib)
set(CMAKE_BUILD_RPATH ${PALPA_LOADED_FROM})
set(PALPA_LOADED_INSTALLED lib/palpa)
set(CMAKE_INSTALL_RPATH $ORIGIN/../${PALPA_LOADED_INSTALLED})

option(PALPA_TESTS "Build the tests" ON)
option(PALPA_FULL "Tests have the time that every stated count takes" OFF)
option(PALPA_WERROR "Treat warnings as errors" OFF)
set(PALPA_SANITIZE "" CACHE STRING "Sanitizers, e.g. address,undefined or thread")
set(PALPA_PREBUILT "" CACHE PATH
  "A build without sanitizers: modules not in PALPA_SANITIZED are linked from it, not compiled")
set(PALPA_SANITIZED "" CACHE STRING "Modules that the sanitizers look into, where PALPA_PREBUILT")

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

# Same binary, same seed, same bits: no fused multiply-add behind our back, no
# fast-math, no -march=native.
add_compile_options(-ffp-contract=off)
add_compile_options(-Wall -Wextra -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual)
if(PALPA_WERROR)
  add_compile_options(-Werror)
endif()
# GCC 13 and later suspect every reference that comes out of a function with a temporary argument;
# and of strings put together, what their optimizer makes of them. The latter is shown, no error.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
  add_compile_options(-Wno-dangling-reference -Wno-error=array-bounds -Wno-error=restrict
                      -Wno-error=stringop-overflow -Wno-error=maybe-uninitialized)
endif()
# GCC gives memory back and asks for it again all the time; where that is slow (virtual machines) it
# takes a third of the build.
set(PALPA_COMPILER_HEAP_MB 256 CACHE STRING
  "Memory that one run of GCC takes before it tidies up; times the number of jobs it must fit")
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND PALPA_COMPILER_HEAP_MB)
  math(EXPR heap_kB "${PALPA_COMPILER_HEAP_MB} * 1024")
  add_compile_options("SHELL:--param ggc-min-heapsize=${heap_kB}")
endif()
# Eigen picks its allocator by whether a source is looked into: what one source allocates, the
# next would free in another way. So it is the one that Eigen has without sanitizers.
if(PALPA_SANITIZE)
  add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)
  add_compile_options(-fsanitize=${PALPA_SANITIZE} -fno-omit-frame-pointer -g1)
  # They open libraries in the program's place: for that only a run path of the old kind counts.
  add_link_options(-fsanitize=${PALPA_SANITIZE} -Wl,--disable-new-dtags)
endif()
# Where not everything is looked into, in half the time: a null pointer stops the program as well.
if(PALPA_SANITIZE MATCHES "undefined" AND PALPA_PREBUILT)
  add_compile_options(-fno-sanitize=null,alignment)
endif()

# What a fault in parsing, of ours or of a library, must not become: a smashed stack is noticed,
# calls whose size is known are checked, addresses cannot be rewritten after the start. Sanitizers
# see more.
option(PALPA_HARDENED "Stack protector, fortified calls, immediate binding" ON)
if(PALPA_HARDENED AND NOT PALPA_SANITIZE)
  add_compile_options(-fstack-protector-strong -fstack-clash-protection)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    add_compile_options(-fcf-protection)
  endif()
  if(NOT CMAKE_BUILD_TYPE STREQUAL "Debug")  # fortified calls need the optimizer
    add_compile_options(-U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=3)
  endif()
  add_link_options(-Wl,-z,relro,-z,now)
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
  set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE_PROGRAM})
endif()
# Not mold: 1.10 lays out some programs so that the loader refuses them ("cannot apply additional
# memory protection after relocation").
find_program(LLD_PROGRAM ld.lld)
if(LLD_PROGRAM)
  add_link_options(-fuse-ld=lld)
endif()
