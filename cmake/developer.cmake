# SPDX-License-Identifier: Apache-2.0
# Options for articula's own tests, benchmarks and examples. Users' targets do not get them.

set(ARTICULA_SANITIZE "" CACHE STRING "Sanitizers to build with, as address;undefined or thread")
option(ARTICULA_QUICK_BUILD "Compile faster: servers, the program and benchmarks with -O0, as tests are" OFF)

# ISO C++. With GNU extensions g++ may also fuse multiplications and additions.
set(CMAKE_CXX_EXTENSIONS OFF)

# Warnings of articula's code. The presets of tests make errors of them. A user's build goes on: other
# compilers and optimisations warn of other things. Eigen and other libraries are imported targets,
# so their headers are system includes without warnings.
add_library(articula_warnings INTERFACE)
target_compile_options(
  articula_warnings
  INTERFACE -Wall
            -Wextra
            -Wpedantic
            -Wshadow
            -Wconversion
            -Wsign-conversion
            -Wold-style-cast
            -Wnon-virtual-dtor
            -Woverloaded-virtual
            -Wdouble-promotion)

# g++ collects its garbage less often, and links by the faster of its linkers. With the address
# sanitizer of clang++ that linker warns.
if(ARTICULA_QUICK_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options(--param=ggc-min-heapsize=1000000)
  include(CheckLinkerFlag)
  check_linker_flag(CXX -fuse-ld=gold ARTICULA_HAS_GOLD)
  if(ARTICULA_HAS_GOLD)
    add_link_options(-fuse-ld=gold)
  endif()
endif()

add_library(articula_sanitizers INTERFACE)
if(ARTICULA_SANITIZE)
  list(JOIN ARTICULA_SANITIZE "," sanitizers)
  target_compile_options(
    articula_sanitizers
    INTERFACE -fsanitize=${sanitizers} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(articula_sanitizers INTERFACE -fsanitize=${sanitizers})
endif()

if(PROJECT_IS_TOP_LEVEL AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(ARTICULA_CCACHE ccache DOC "Compiler cache, used when found")
  if(ARTICULA_CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${ARTICULA_CCACHE})
  endif()
endif()
