# SPDX-License-Identifier: Apache-2.0

# articula_add_object_code_check(<name> SOURCE <file> [ALLOW <regex>...])
#
# Compiles <file> as a user's release build would (-O2 -DNDEBUG) and reads the symbols that the
# object code refers to. The ctest <name> passes if all are known to be harmless in a control loop:
# memory copies and elementary functions, see check_object_code.cmake. So no allocation, exception,
# lock, stdio or system call can be reached from it. ALLOW adds symbols for this file.
function(articula_add_object_code_check name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "SOURCE" "ALLOW")
  if(ARTICULA_SANITIZE)
    articula_skip_test(${name} "sanitizers add their own calls to the object code")
    return()
  endif()
  add_library(${name} OBJECT ${arg_SOURCE})
  target_compile_options(${name} PRIVATE -O2 -DNDEBUG)
  target_link_libraries(${name} PRIVATE articula::articula articula_warnings)
  add_test(NAME ${name}
           COMMAND ${CMAKE_COMMAND} "-DNM=${CMAKE_NM}" "-DOBJECT=$<TARGET_OBJECTS:${name}>"
                   "-DALLOW=${arg_ALLOW}" -P
                   ${PROJECT_SOURCE_DIR}/tests/support/cmake/check_object_code.cmake)
endfunction()
