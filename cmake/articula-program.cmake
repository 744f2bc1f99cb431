# SPDX-License-Identifier: Apache-2.0
# The program articula: running loops from a terminal, and robots from files; see docs/terminal.md.
# It is built if all that it needs is found.

find_package(CLI11 QUIET)
set(articula_program_lacks "")
foreach(
  need IN
  ITEMS "articula::view|Boost 1.81 (Debian 12: libboost1.81-dev, later: libboost-dev)"
        "CLI11::CLI11|CLI11 (Debian: libcli11-dev)"
        "articula::recording|nlohmann-json (Debian: nlohmann-json3-dev)"
        "articula::config|yaml-cpp (Debian: libyaml-cpp-dev)"
        "articula::urdf|urdfdom (Debian: liburdfdom-dev)")
  string(REPLACE "|" ";" need "${need}")
  list(GET need 0 target)
  if(NOT TARGET ${target})
    list(GET need 1 package)
    list(APPEND articula_program_lacks ${package})
  endif()
endforeach()
if(articula_program_lacks)
  list(JOIN articula_program_lacks ", " articula_program_lacks)
  message(STATUS "The program articula is not built; it needs: ${articula_program_lacks}")
  return()
endif()

set(articula_program_folder ${CMAKE_CURRENT_LIST_DIR}/articula)
file(GLOB articula_program_files CONFIGURE_DEPENDS
     ${articula_program_folder}/*.cpp ${articula_program_folder}/commands/*.cpp
     ${articula_program_folder}/files/*.cpp ${articula_program_folder}/project/*.cpp)
# Loops of `articula run` for some sizes of robots, each in a file of its own: they are slow to compile.
# With -O1 they take less time, and a cycle is still far shorter than a millisecond.
set(ARTICULA_RUN_JOINTS
    "1;2;3;4;5;6;7;8;7+5;8+1"
    CACHE STRING "Sizes of the robots that articula run takes: 7 joints, or 7+5 for 7 joints and 5 mimic joints")
set(articula_run_sizes "")
foreach(size IN LISTS ARTICULA_RUN_JOINTS)
  if(NOT size MATCHES "^([1-9][0-9]*)(\\+([1-9][0-9]*))?$")
    message(FATAL_ERROR "ARTICULA_RUN_JOINTS: \"${size}\" is not a size of a robot; write \"7\", or \"7+5\"")
  endif()
  set(joints ${CMAKE_MATCH_1})
  set(bodies ${joints})
  if(CMAKE_MATCH_3)
    math(EXPR bodies "${joints} + ${CMAKE_MATCH_3}")
  endif()
  string(APPEND articula_run_sizes "{${joints}, ${bodies}},")
  set(articula_loop_file ${PROJECT_BINARY_DIR}/articula_loops/run_loop_${joints}_${bodies}.cpp)
  configure_file(${articula_program_folder}/loops/run_loop.cpp.in ${articula_loop_file} @ONLY)
  set_source_files_properties(${articula_loop_file} PROPERTIES COMPILE_OPTIONS -O1
                                                              SKIP_PRECOMPILE_HEADERS ON)
  list(APPEND articula_program_files ${articula_loop_file})
endforeach()
add_executable(articula_program ${articula_program_files})
target_include_directories(articula_program PRIVATE ${articula_program_folder})
target_precompile_headers(articula_program PRIVATE <CLI/CLI.hpp>)
target_compile_options(articula_program PRIVATE $<$<BOOL:${ARTICULA_QUICK_BUILD}>:-O0>)
set_target_properties(articula_program PROPERTIES OUTPUT_NAME articula)
set_property(
  SOURCE ${articula_program_folder}/commands/run_command.cpp
  APPEND
  PROPERTY COMPILE_DEFINITIONS "ARTICULA_RUN_SIZES=${articula_run_sizes}")
target_link_libraries(articula_program PRIVATE articula::recording articula::config articula::urdf
                                               articula::view CLI11::CLI11)

# What offers loops to ROS 2. Without Fast DDS it refuses.
add_library(articula_ros2_command OBJECT ${articula_program_folder}/ros2/ros2_options.cpp)
target_include_directories(articula_ros2_command PRIVATE ${articula_program_folder})
target_compile_options(articula_ros2_command PRIVATE $<$<BOOL:${ARTICULA_QUICK_BUILD}>:-O0>)
target_link_libraries(articula_ros2_command PRIVATE articula::recording CLI11::CLI11)
if(TARGET articula::ros2)
  target_compile_definitions(articula_ros2_command PRIVATE ARTICULA_PROGRAM_HAS_ROS2)
  target_link_libraries(articula_ros2_command PRIVATE articula::ros2)
  target_link_libraries(articula_program PRIVATE $<LINK_ONLY:articula::ros2>)
endif()
if(TARGET articula_warnings)
  target_link_libraries(articula_ros2_command PRIVATE articula_warnings articula_sanitizers)
endif()
target_link_libraries(articula_program PRIVATE articula_ros2_command)

# The command sweep, if its library is found. Its loops, too, are compiled for some numbers of joints.
set(ARTICULA_SWEPT_JOINTS
    "2;6;7"
    CACHE STRING "Numbers of joints of the robots that articula sweep takes; without any there is no sweep")
if(TARGET articula::sweep AND ARTICULA_SWEPT_JOINTS)
  file(GLOB articula_sweep_files CONFIGURE_DEPENDS ${articula_program_folder}/sweep/*.cpp)
  foreach(joints IN LISTS ARTICULA_SWEPT_JOINTS)
    set(articula_loop_file ${PROJECT_BINARY_DIR}/articula_loops/make_experiment_${joints}.cpp)
    configure_file(${articula_program_folder}/sweep/make_experiment.cpp.in ${articula_loop_file}
                   @ONLY)
    set_source_files_properties(${articula_loop_file} PROPERTIES COMPILE_OPTIONS
                                                                $<$<BOOL:${ARTICULA_QUICK_BUILD}>:-O2>)
    list(APPEND articula_sweep_files ${articula_loop_file})
  endforeach()
  # The option --compile compiles this header with a robot.
  set(articula_experiment_file ${articula_program_folder}/sweep/any_experiment.hpp)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${articula_experiment_file})
  file(READ ${articula_experiment_file} articula_any_experiment)
  configure_file(${articula_program_folder}/sweep/any_experiment_text.hpp.in
                 ${PROJECT_BINARY_DIR}/articula_loops/sweep/any_experiment_text.hpp @ONLY)
  add_library(articula_sweep_command OBJECT ${articula_sweep_files})
  target_compile_options(articula_sweep_command PRIVATE $<$<BOOL:${ARTICULA_QUICK_BUILD}>:-O0>)
  target_include_directories(articula_sweep_command PRIVATE ${articula_program_folder}
                                                            ${PROJECT_BINARY_DIR}/articula_loops)
  target_link_libraries(articula_sweep_command PRIVATE articula::sweep articula::recording articula::config
                                                       articula::urdf CLI11::CLI11 ${CMAKE_DL_LIBS})
  list(JOIN ARTICULA_SWEPT_JOINTS "," articula_swept_joints)
  target_compile_definitions(articula_sweep_command
                             PRIVATE "ARTICULA_SWEPT_JOINTS=${articula_swept_joints}")
  foreach(part hdf5 mpi search)
    if(TARGET articula::sweep_${part})
      string(TOUPPER ${part} articula_part)
      target_compile_definitions(articula_sweep_command PRIVATE ARTICULA_PROGRAM_HAS_${articula_part})
      target_link_libraries(articula_sweep_command PRIVATE articula::sweep_${part})
      target_link_libraries(articula_program PRIVATE articula::sweep_${part})
    endif()
  endforeach()
  if(TARGET articula_warnings)
    target_link_libraries(articula_sweep_command PRIVATE articula_warnings articula_sanitizers)
  endif()
  target_compile_definitions(articula_program PRIVATE ARTICULA_PROGRAM_HAS_SWEEP)
  target_link_libraries(articula_program PRIVATE articula_sweep_command articula::sweep)
endif()
if(TARGET articula_warnings)
  target_link_libraries(articula_program PRIVATE articula_warnings articula_sanitizers)
endif()
if(ARTICULA_INSTALL)
  install(TARGETS articula_program OPTIONAL) # who installs the headers alone need not build it
endif()
