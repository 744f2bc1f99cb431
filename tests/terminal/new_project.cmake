# SPDX-License-Identifier: Apache-2.0
# Installs articula into a scratch prefix, and lets the installed program compile a robot, run it and
# operate it.
file(REMOVE_RECURSE ${WORK})

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run(${CMAKE_COMMAND} --install ${BINARY} --prefix ${WORK}/prefix)
# The robot has visuals.
file(READ ${URDF} urdf)
string(REPLACE "<link name=\"torso_link\">"
               "<link name=\"torso_link\"><visual><geometry><sphere radius=\"0.1\"/></geometry></visual>" urdf
               "${urdf}")
file(WRITE ${WORK}/two_arm_torso.urdf "${urdf}")

# `run --compile` writes the project that `new` writes, and builds it as a user would.
set(ENV{XDG_CACHE_HOME} ${WORK}/cache)
set(ENV{CXX} ${COMPILER})
set(ENV{CMAKE_CXX_COMPILER_LAUNCHER} ${LAUNCHER})
set(ENV{CMAKE_GENERATOR} ${GENERATOR})
set(ENV{CMAKE_BUILD_TYPE} None) # which compiles much faster than the project's own choice, Release
set(run ${WORK}/prefix/bin/articula --port 0 run ${WORK}/two_arm_torso.urdf ${CONTROLLERS} --compile)
run(bash ${CMAKE_CURRENT_LIST_DIR}/operate.sh ${PROGRAM} ${run})
run(${PROGRAM} new ${WORK}/two_arm_torso.urdf ${CONTROLLERS} --output ${WORK}/project)
file(GLOB compiled ${WORK}/cache/articula/*)
foreach(name CMakeLists.txt main.cpp robot.urdf controllers.yaml)
  run(${CMAKE_COMMAND} -E compare_files ${compiled}/${name} ${WORK}/project/${name})
endforeach()
# The second time nothing is compiled.
execute_process(COMMAND ${run} --seconds 0.01 ERROR_VARIABLE errors COMMAND_ERROR_IS_FATAL ANY)
if(errors MATCHES "compiles the robot")
  message(FATAL_ERROR "the program was not kept: ${errors}")
endif()

# A project for drives on a CAN bus compiles, too.
file(READ ${CONTROLLERS} controllers)
file(WRITE ${WORK}/can.yaml "${controllers}can_drives:\n  ros__parameters:\n    protocol: cia402\n")
execute_process(COMMAND ${PROGRAM} --json joints --moving ${URDF} OUTPUT_VARIABLE joints COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "\"name\":\"[^\"]*\",\"type\"" names "${joints}")
set(node 0)
foreach(name IN LISTS names)
  string(REGEX REPLACE "\"name\":\"([^\"]*)\".*" "\\1" name ${name})
  math(EXPR node "${node} + 1")
  file(APPEND ${WORK}/can.yaml "    ${name}: {node: ${node}, rated_effort: 100.0, position_scale: 10.0, velocity_scale: 1.0}\n")
endforeach()
run(${PROGRAM} new ${URDF} ${WORK}/can.yaml --can can0 --output ${WORK}/on_can)
run(${CMAKE_COMMAND} -S ${WORK}/on_can -B ${WORK}/on_can/build -DCMAKE_BUILD_TYPE=None
    -Darticula_ROOT=${WORK}/prefix "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Werror")
if(GENERATOR MATCHES Ninja) # the libraries have been built above
  run(${CMAKE_COMMAND} --build ${WORK}/on_can/build --target CMakeFiles/two_arm_torso.dir/main.cpp.o)
else()
  run(${CMAKE_COMMAND} --build ${WORK}/on_can/build)
endif()

# `sweep --compile` has the runs of `sweep`.
set(ENV{XDG_CACHE_HOME} ${WORK}/sweep_cache)
if(HAS_SWEEP)
  run(sh ${CMAKE_CURRENT_LIST_DIR}/compiled_sweep.sh ${WORK}/prefix/bin/articula
      ${SWEEP} ${WORK}/sweep)
endif()
