# SPDX-License-Identifier: Apache-2.0
# Installs articula into a scratch prefix, writes a project by PROGRAM, builds it against the
# installed package and runs it beside `articula status`.
file(REMOVE_RECURSE ${WORK})

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run(${CMAKE_COMMAND} --install ${BINARY} --prefix ${WORK}/prefix)
run(${PROGRAM} new ${URDF} ${CONTROLLERS} --output ${WORK}/project)
# A port that nothing else has.
file(READ ${WORK}/project/main.cpp main)
string(REPLACE "articula::show(arm)" "articula::show(arm, {.view = {.port = 0, .operates = true}})" main
               "${main}")
file(WRITE ${WORK}/project/main.cpp "${main}")
run(${CMAKE_COMMAND} -S ${WORK}/project -B ${WORK}/build -G ${GENERATOR}
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}
    -DCMAKE_PREFIX_PATH=${WORK}/prefix)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(bash ${CMAKE_CURRENT_LIST_DIR}/operate.sh ${WORK}/build/two_arm_torso ${PROGRAM})
