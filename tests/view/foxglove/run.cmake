# SPDX-License-Identifier: Apache-2.0
# cmake -DSOURCE=<folder> -DWORK=<folder> -DNPM=<npm> -DNODE=<node> -DVIEW=<program> -P run.cmake
#
# Runs client_test.mjs with the packages of the lock file, in a folder of its own. Where they cannot be
# fetched, as without a network, the test is skipped.

file(COPY ${SOURCE}/ DESTINATION ${WORK})
if(NOT EXISTS ${WORK}/node_modules/@foxglove/rosmsg2-serialization/package.json)
  execute_process(
    COMMAND ${NPM} ci --no-audit --no-fund --ignore-scripts
    WORKING_DIRECTORY ${WORK}
    RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message("Skipped: npm cannot fetch Foxglove's packages")
    return()
  endif()
endif()
execute_process(COMMAND ${NODE} ${WORK}/client_test.mjs ${VIEW} COMMAND_ERROR_IS_FATAL ANY)
