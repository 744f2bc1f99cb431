# SPDX-License-Identifier: Apache-2.0
# RUN must print what NATIVE prints.
execute_process(COMMAND ${NATIVE} OUTPUT_VARIABLE expected COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${RUN} OUTPUT_VARIABLE printed COMMAND_ERROR_IS_FATAL ANY)
string(LENGTH "${expected}" length)
message("${length} bytes of cycles and answers")
if(length LESS 100000)
  message(FATAL_ERROR "there are too few cycles:\n${expected}")
endif()
if(NOT printed STREQUAL expected)
  message(FATAL_ERROR "the bits differ")
endif()
