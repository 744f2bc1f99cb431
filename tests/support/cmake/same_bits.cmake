# SPDX-License-Identifier: Apache-2.0

# articula_add_same_bits_test(<name> SOURCE <file> [OPTIONS <compiler option>...])
#
# Builds <file> as it is and once with each of the options, in targets that ask for the same bits
# (ARTICULA_SAME_BITS), and lets the other compiler, g++ or clang++, compile it with the first of
# the options when ctest runs, if there is one. The ctest <name> passes if all programs print the same. One that finds that this
# processor lacks what it was compiled for prints nothing and is left out.
function(articula_add_same_bits_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "SOURCE" "OPTIONS")
  cmake_path(ABSOLUTE_PATH arg_SOURCE)
  set(programs "")
  foreach(options "" ${arg_OPTIONS})
    string(MAKE_C_IDENTIFIER "${name}${options}" program)
    add_executable(${program} ${arg_SOURCE})
    set_target_properties(${program} PROPERTIES ARTICULA_SAME_BITS ON)
    separate_arguments(option_list UNIX_COMMAND "${options}")
    target_compile_options(${program} PRIVATE ${option_list})
    target_link_libraries(${program} PRIVATE articula::articula articula_sanitizers)
    list(APPEND programs $<TARGET_FILE:${program}>)
  endforeach()
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    find_program(ARTICULA_OTHER_COMPILER NAMES clang++-19 clang++)
    set(other_options -ffp-contract=off -fconstexpr-steps=1000000000)
  else()
    find_program(ARTICULA_OTHER_COMPILER NAMES g++)
    set(other_options -ffp-contract=off -fno-tree-slp-vectorize -fconstexpr-ops-limit=1000000000)
  endif()
  set(first_option "")
  if(arg_OPTIONS)
    list(GET arg_OPTIONS 0 first_option)
  endif()
  separate_arguments(first_option UNIX_COMMAND "${first_option}")
  add_test(
    NAME ${name}
    COMMAND
      ${CMAKE_COMMAND} "-DPROGRAMS=${programs}" "-DCOMPILER=${ARTICULA_OTHER_COMPILER}"
      "-DOPTIONS=-std=c++20;-O2;-w;${other_options};${first_option}"
      "-DSOURCE=${arg_SOURCE}" "-DPROGRAM=${CMAKE_CURRENT_BINARY_DIR}/${name}_other"
      "-DINCLUDES=$<TARGET_PROPERTY:articula_compilation,INCLUDE_DIRECTORIES>" -P
      ${PROJECT_SOURCE_DIR}/tests/support/cmake/check_same_bits.cmake)
endfunction()
