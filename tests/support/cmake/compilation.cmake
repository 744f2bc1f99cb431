# SPDX-License-Identifier: Apache-2.0
# Tests of what must, and what must not, compile. They run the compiler when ctest runs.

# Never built: it only lends its include directories to the two functions below.
add_library(articula_compilation OBJECT EXCLUDE_FROM_ALL ${CMAKE_CURRENT_LIST_DIR}/../main.cpp)
target_link_libraries(articula_compilation PRIVATE articula::articula)
target_include_directories(articula_compilation PRIVATE ${CMAKE_CURRENT_LIST_DIR}/..)

# What the sources include takes most of these tests' time, so it is compiled once for all of them.
# g++ reads the header itself where a test's options differ; clang++ refuses then, so it gets none.
set(articula_compilation_header "")
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(articula_compilation_header ${CMAKE_CURRENT_BINARY_DIR}/compilation/all.hpp)
  file(CONFIGURE OUTPUT ${articula_compilation_header} CONTENT "#include <articula/articula.hpp>\n")
  set(includes "$<TARGET_PROPERTY:articula_compilation,INCLUDE_DIRECTORIES>")
  add_test(
    NAME static_precompiled_header
    COMMAND
      ${CMAKE_CXX_COMPILER} -std=c++20 "-isystem$<JOIN:${includes},;-isystem>" -x c++-header
      ${articula_compilation_header} -o ${articula_compilation_header}.gch
    COMMAND_EXPAND_LISTS)
  set_tests_properties(static_precompiled_header PROPERTIES FIXTURES_SETUP compilation_header)
endif()

# articula_add_rejection_test(<name> SOURCE <file> [DEFINITIONS <macro>...] EXPECT <regex>...)
# Passes if <file> does not compile and every regex matches somewhere in the compiler's messages.
#
# A typing error in <file> must not pass for a rejection, so let the same <file> be accepted too:
# without the macro that brings in the mistake.
function(articula_add_rejection_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "SOURCE" "DEFINITIONS;EXPECT")
  if(NOT arg_EXPECT)
    message(FATAL_ERROR "${name}: say with EXPECT what the compiler is to complain about")
  endif()
  articula_add_compilation_test(${name} ${arg_SOURCE} "${arg_DEFINITIONS}" "${arg_EXPECT}")
endfunction()

# articula_add_acceptance_test(<name> SOURCE <file> [DEFINITIONS <macro>...])
# Passes if <file> compiles.
function(articula_add_acceptance_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "SOURCE" "DEFINITIONS")
  articula_add_compilation_test(${name} ${arg_SOURCE} "${arg_DEFINITIONS}" "")
endfunction()

function(articula_add_compilation_test name source definitions expect)
  cmake_path(ABSOLUTE_PATH source)
  add_test(
    NAME ${name}
    COMMAND
      ${CMAKE_COMMAND} "-DCOMPILER=${CMAKE_CXX_COMPILER}" "-DSOURCE=${source}"
      "-DINCLUDES=$<TARGET_PROPERTY:articula_compilation,INCLUDE_DIRECTORIES>"
      "-DDEFINITIONS=${definitions}" "-DEXPECT=${expect}"
      "-DHEADER=${articula_compilation_header}" -P
      ${PROJECT_SOURCE_DIR}/tests/support/cmake/check_compilation.cmake)
  set_tests_properties(${name} PROPERTIES FIXTURES_REQUIRED compilation_header)
endfunction()
