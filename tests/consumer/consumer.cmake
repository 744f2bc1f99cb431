# SPDX-License-Identifier: Apache-2.0
# Installs articula into a scratch prefix, then configures, builds and runs PROJECT against it.
# WORK is emptied first: a header that is no longer installed must not be found there.
file(REMOVE_RECURSE ${WORK})

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

if(PROJECT MATCHES "find_package$")
  run(${CMAKE_COMMAND} --install ${BINARY} --prefix ${WORK}/prefix)
endif()
run(${CMAKE_COMMAND} -S ${PROJECT} -B ${WORK}/build -G ${GENERATOR} -DCMAKE_BUILD_TYPE=None
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}
    -DCMAKE_PREFIX_PATH=${WORK}/prefix -DARTICULA_SOURCE_DIR=${SOURCE})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)
