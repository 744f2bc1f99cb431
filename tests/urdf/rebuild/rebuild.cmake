# SPDX-License-Identifier: Apache-2.0
# A robot of articula_add_robot follows its URDF: a file that changes is read again by the next build,
# and one with a fault stops it, with the file, the element and the reason. So does a wrong call.
#   cmake -DPROJECT=<folder of this file> -DWORK=<scratch folder> -DSOURCE=<articula>
#         -DGENERATOR=<generator> -DCOMPILER=<C++ compiler> [-DLAUNCHER=<compiler cache>] -P rebuild.cmake

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})

# A file system that keeps whole seconds must see that the file is newer.
function(write_robot mass)
  execute_process(COMMAND ${CMAKE_COMMAND} -E sleep 1.1)
  configure_file(${PROJECT}/pendulum.urdf.in ${WORK}/pendulum.urdf @ONLY)
endfunction()

function(build)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK} ${ARGN} RESULT_VARIABLE status
                  OUTPUT_VARIABLE output ERROR_VARIABLE output)
  set(status ${status} PARENT_SCOPE)
  set(output "${output}" PARENT_SCOPE)
endfunction()

function(expect_mass_matrix expected)
  build(--target print_mass)
  if(status)
    message(FATAL_ERROR "the build failed:\n${output}")
  endif()
  execute_process(COMMAND ${WORK}/print_mass OUTPUT_VARIABLE printed COMMAND_ERROR_IS_FATAL ANY)
  string(STRIP "${printed}" printed)
  if(NOT printed STREQUAL expected)
    message(FATAL_ERROR "the mass matrix is ${printed}, not ${expected}")
  endif()
endfunction()

write_robot(2)
execute_process(
  COMMAND
    ${CMAKE_COMMAND} -S ${PROJECT} -B ${WORK} -G ${GENERATOR} -DSOURCE=${SOURCE} -DCMAKE_BUILD_TYPE=None
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}
    -DARTICULA_BUILD_TESTS=OFF -DARTICULA_BUILD_BENCHMARKS=OFF -DARTICULA_BUILD_EXAMPLES=OFF
  COMMAND_ERROR_IS_FATAL ANY)
expect_mass_matrix(2.25)
if(EXISTS ${WORK}/articula_robots/LeftAlone/left_alone.hpp)
  message(FATAL_ERROR "print_mass needs no other robot")
endif()
build()
if(status OR NOT EXISTS ${WORK}/articula_robots/LeftAlone/left_alone.hpp)
  message(FATAL_ERROR "a whole build does not make the robot that nobody links:\n${output}")
endif()

write_robot(3)
expect_mass_matrix(3.25)

write_robot(-3)
build(--target print_mass)
if(NOT status)
  message(FATAL_ERROR "a negative mass was accepted:\n${output}")
endif()
foreach(word pendulum.urdf rod mass -3)
  if(NOT output MATCHES "error: [^\n]*${word}")
    message(FATAL_ERROR "the error does not name '${word}':\n${output}")
  endif()
endforeach()

# Wrong calls: the message names the robot, what is wrong with it, and what there is instead.
function(expect_refusal call)
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${PROJECT} -B ${WORK} "-DWRONG=${call}"
                  RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status)
    build(--target Wrong_header)
  endif()
  if(NOT status)
    message(FATAL_ERROR "articula_add_robot(${call}) was accepted:\n${output}")
  endif()
  string(REGEX REPLACE "[ \n]+" " " output "${output}") # CMake breaks lines
  foreach(words IN LISTS ARGN)
    string(FIND "${output}" "${words}" place)
    if(place EQUAL -1)
      message(FATAL_ERROR "articula_add_robot(${call}): nothing says '${words}':\n${output}")
    endif()
  endforeach()
endfunction()

set(urdf ${WORK}/pendulum.urdf)
write_robot(2)
expect_refusal("Wrong;URDF;${urdf};LOKC;pivot" "articula_add_robot(Wrong)" "LOKC" "LOCK")
expect_refusal("Wrong;URDF;${urdf};ALLOW_UNPHYSICAL;OFF" "unknown argument OFF")
expect_refusal("Wrong;URDF;${urdf};ROOT" "articula_add_robot(Wrong)" "ROOT has no value")
expect_refusal("Wrong;TIP;rod" "URDF <file> is missing")
expect_refusal("Pendulum;URDF;${urdf}" "articula_add_robot(Pendulum)" "a target Pendulum")
expect_refusal("Wrong;URDF;${urdf};GRAVITY;0;0;x" "GRAVITY: 'x' is not a finite number")
expect_refusal("Wrong;URDF;${urdf};LOCK;pivot=abc" "LOCK pivot=abc: 'abc' is not")
expect_refusal("Wrong;URDF;${urdf};TIP;rodd" "tip 'rodd'" "did you mean 'rod'?")
