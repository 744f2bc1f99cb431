# SPDX-License-Identifier: Apache-2.0
# Runs PROGRAMS, and PROGRAM, which COMPILER makes of SOURCE with OPTIONS, and compares what they
# print. See same_bits.cmake.

if(COMPILER)
  list(TRANSFORM INCLUDES PREPEND -I)
  execute_process(COMMAND ${COMPILER} ${OPTIONS} ${INCLUDES} ${SOURCE} -o ${PROGRAM}
                  COMMAND_ERROR_IS_FATAL ANY)
  list(APPEND PROGRAMS ${PROGRAM})
endif()

set(expected "")
set(compared 0)
foreach(program IN LISTS PROGRAMS)
  execute_process(COMMAND ${program} OUTPUT_VARIABLE printed COMMAND_ERROR_IS_FATAL ANY)
  if(printed STREQUAL "")
    message("${program}: this processor cannot run it")
  elseif(expected STREQUAL "")
    set(expected "${printed}")
    set(first ${program})
  elseif(printed STREQUAL expected)
    math(EXPR compared "${compared} + 1")
  else()
    message("${first} prints\n${expected}")
    message("${program} prints\n${printed}")
    message(FATAL_ERROR "the bits of results depend on the compiler or its options")
  endif()
endforeach()
message("${compared} programs print what ${first} prints")
if(compared EQUAL 0)
  message(FATAL_ERROR "there is nothing to compare with")
endif()
