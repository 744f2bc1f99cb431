# SPDX-License-Identifier: Apache-2.0
# Runs COMPILER on SOURCES with INCLUDES and options for EXCEPTIONS. If there is NATIVE, RUN must print what NATIVE prints.
list(TRANSFORM INCLUDES PREPEND -I)
if(NOT EXCEPTIONS)
  set(EXCEPTIONS -Xclang -fignore-exceptions)
endif()
execute_process(
  COMMAND ${COMPILER} --target=wasm32-wasi -std=c++20 -O2 -msimd128 -fconstexpr-steps=1000000000
          ${EXCEPTIONS} ${INCLUDES} ${SOURCES}
  COMMAND_ERROR_IS_FATAL ANY)
if(NATIVE)
  execute_process(COMMAND ${NATIVE} OUTPUT_VARIABLE expected COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${RUN} OUTPUT_VARIABLE printed COMMAND_ERROR_IS_FATAL ANY)
  message("natively:       ${expected}as WebAssembly: ${printed}")
  if(NOT printed STREQUAL expected OR expected STREQUAL "")
    message(FATAL_ERROR "the bits differ")
  endif()
endif()
