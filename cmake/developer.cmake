# SPDX-License-Identifier: Apache-2.0
# What our own tests, benchmarks and examples are built with. Nothing here reaches a user.

set(ARTICULA_SANITIZE "" CACHE STRING "Sanitizers to build with, as address;undefined or thread")

# ISO C++; with GNU extensions g++ would also be free to fuse multiplications and additions.
set(CMAKE_CXX_EXTENSIONS OFF)

# Warnings are errors in our code. Eigen and the others are imported targets, hence system includes.
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
            -Wdouble-promotion
            -Werror)

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
