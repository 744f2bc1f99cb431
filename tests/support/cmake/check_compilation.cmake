# SPDX-License-Identifier: Apache-2.0
# cmake -DCOMPILER= -DSOURCE= -DDEFINITIONS= -DINCLUDES= -DEXPECT= -DHEADER= -P check_compilation.cmake
# HEADER is included first, if there is one. With EXPECT empty SOURCE must compile, else it must not
# and each regex of EXPECT must match.

list(TRANSFORM DEFINITIONS PREPEND -D)
list(TRANSFORM INCLUDES PREPEND -isystem)
if(HEADER)
  list(PREPEND DEFINITIONS -include ${HEADER})
endif()
set(ENV{LC_ALL} C) # messages in English

execute_process(
  COMMAND ${COMPILER} -std=c++20 -fsyntax-only ${DEFINITIONS} ${INCLUDES} ${SOURCE}
  RESULT_VARIABLE result
  OUTPUT_VARIABLE messages
  ERROR_VARIABLE messages)

if(NOT EXPECT)
  if(NOT result EQUAL 0)
    message("${messages}")
    message(FATAL_ERROR "must compile, but does not: ${SOURCE}")
  endif()
  return()
endif()

if(result EQUAL 0)
  message(FATAL_ERROR "must not compile, but does: ${SOURCE}")
endif()
foreach(regex IN LISTS EXPECT)
  if(NOT messages MATCHES "${regex}")
    message("${messages}")
    message(FATAL_ERROR "does not compile, as it should, but no message matches '${regex}'")
  endif()
endforeach()
