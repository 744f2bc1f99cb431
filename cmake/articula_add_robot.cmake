# SPDX-License-Identifier: Apache-2.0

# articula_add_robot(<Name> URDF <file> [ROOT <link>] [TIP <link>] [NAMESPACE <namespace>]
#                    [LOCK <joint>[=<position>]...] [GRAVITY <x> <y> <z>]
#                    [RIGHT_ANGLE_TOLERANCE <number>] [ALLOW_UNPHYSICAL] [KINEMATIC])
#
# Makes an INTERFACE target <Name>. Who links it can include <name>.hpp (the name in snake case:
# LbrIiwa is in lbr_iiwa.hpp), which defines `struct <Name>`, in the namespace if one is given, with
# the robot as a constexpr RobotDescription. The header is made anew when the URDF changes; a URDF
# with a fault stops the build with the element, the reason and figures.
#
#   ROOT              link that becomes the fixed base, instead of the URDF's root
#   TIP               link at which a chain from the root ends; the rest is left out with its mass, with a
#                     warning if joints of the chain carry it
#   LOCK              joints to be held in place, at 0 or at a position [rad or m]; beyond the joint's
#                     limits with a warning. Joints that mimic one of them are held, too
#   GRAVITY           acceleration of free fall in the root link's frame, 0 0 -9.81 [m/s^2] if not given
#   RIGHT_ANGLE_TOLERANCE  how far from 0, 1 and -1 the elements of rotations may be that dynamics
#                     takes for those of right angles written with few digits, 1e-7 if not given; 0
#                     takes every angle as it is written, 0.1 is the largest
#   ALLOW_UNPHYSICAL  accept inertias that no real body has, with a warning for each
#   KINEMATIC         leave out all masses: the robot has kinematics, and no dynamics. For files without
#                     masses
#
# The program that reads the URDF is built along, for the machine that builds. When cross-compiling,
# set ARTICULA_URDF_TO_ROBOT to one that was built before.
function(articula_add_robot name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "ALLOW_UNPHYSICAL;KINEMATIC"
                        "URDF;ROOT;TIP;NAMESPACE;RIGHT_ANGLE_TOLERANCE" "LOCK;GRAVITY")
  if(DEFINED arg_UNPARSED_ARGUMENTS) # the text OFF is something, too
    message(FATAL_ERROR "articula_add_robot(${name}): unknown: ${arg_UNPARSED_ARGUMENTS}; options: "
                        "URDF, ROOT, TIP, NAMESPACE, LOCK, GRAVITY, RIGHT_ANGLE_TOLERANCE, "
                        "ALLOW_UNPHYSICAL, KINEMATIC")
  endif()
  if(DEFINED arg_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "articula_add_robot(${name}): without value: ${arg_KEYWORDS_MISSING_VALUES}")
  endif()
  if(NOT arg_URDF)
    message(FATAL_ERROR "articula_add_robot(${name}): URDF <file> is missing")
  endif()
  if(NOT name MATCHES "^[A-Za-z][A-Za-z0-9_]*$")
    message(FATAL_ERROR "articula_add_robot(${name}): that cannot be the name of a struct")
  endif()
  if(TARGET ${name} OR TARGET ${name}_header)
    message(FATAL_ERROR "articula_add_robot(${name}): there is a target of that name already")
  endif()
  set(urdf ${arg_URDF})
  cmake_path(ABSOLUTE_PATH urdf BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} NORMALIZE)
  get_source_file_property(generated ${urdf} GENERATED)
  if(NOT generated AND NOT EXISTS ${urdf})
    message(FATAL_ERROR "articula_add_robot(${name}): there is no file ${urdf}")
  endif()
  articula_urdf_to_robot(tool)

  string(REGEX REPLACE "([A-Z]+)([A-Z][a-z])" "\\1_\\2" snake_case ${name})
  string(REGEX REPLACE "([a-z0-9])([A-Z])" "\\1_\\2" snake_case ${snake_case})
  string(TOLOWER ${snake_case} snake_case)
  set(directory ${CMAKE_CURRENT_BINARY_DIR}/articula_robots/${name})
  set(header ${directory}/${snake_case}.hpp)
  file(MAKE_DIRECTORY ${directory})

  set(options --urdf ${urdf} --output ${header} --type ${name})
  foreach(option ROOT TIP NAMESPACE RIGHT_ANGLE_TOLERANCE)
    if(DEFINED arg_${option})
      string(TOLOWER ${option} word)
      string(REPLACE _ - word ${word})
      list(APPEND options --${word} ${arg_${option}})
    endif()
  endforeach()
  foreach(joint IN LISTS arg_LOCK)
    list(APPEND options --lock ${joint})
  endforeach()
  if(DEFINED arg_GRAVITY)
    list(LENGTH arg_GRAVITY numbers)
    if(NOT numbers EQUAL 3)
      message(FATAL_ERROR "articula_add_robot(${name}): GRAVITY takes x y z, not '${arg_GRAVITY}'")
    endif()
    list(APPEND options --gravity ${arg_GRAVITY})
  endif()
  if(arg_ALLOW_UNPHYSICAL)
    list(APPEND options --allow-unphysical)
  endif()
  if(arg_KINEMATIC)
    list(APPEND options --kinematic)
  endif()

  add_custom_command(
    OUTPUT ${header}
    COMMAND ${tool} ${options}
    DEPENDS ${urdf} ${tool}
    COMMENT "Making ${snake_case}.hpp from ${arg_URDF}"
    VERBATIM)
  # Part of a whole build, so that a URDF with a fault stops it even where nobody links the robot yet.
  add_custom_target(${name}_header ALL DEPENDS ${header})
  add_library(${name} INTERFACE)
  add_dependencies(${name} ${name}_header)
  target_include_directories(${name} INTERFACE ${directory})
  target_link_libraries(${name} INTERFACE articula::articula)
endfunction()

# Sets the variable to the target or file of the program that reads URDFs.
function(articula_urdf_to_robot variable)
  set(ARTICULA_URDF_TO_ROBOT "" CACHE FILEPATH "urdf_to_robot built before, for cross-compiling")
  mark_as_advanced(ARTICULA_URDF_TO_ROBOT)
  if(ARTICULA_URDF_TO_ROBOT)
    set(${variable} ${ARTICULA_URDF_TO_ROBOT} PARENT_SCOPE)
    return()
  endif()
  if(NOT TARGET articula::urdf)
    message(FATAL_ERROR "articula_add_robot needs urdfdom (Debian: liburdfdom-dev)")
  endif()
  if(CMAKE_CROSSCOMPILING)
    message(FATAL_ERROR "articula_add_robot: set ARTICULA_URDF_TO_ROBOT to a program for this machine")
  endif()
  if(NOT TARGET articula_urdf_to_robot)
    set(source ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/urdf_to_robot)
    add_executable(articula_urdf_to_robot EXCLUDE_FROM_ALL ${source}/urdf_to_robot.cpp
                                                           ${source}/header_text.cpp)
    target_link_libraries(articula_urdf_to_robot PRIVATE articula::urdf)
  endif()
  set(${variable} articula_urdf_to_robot PARENT_SCOPE)
endfunction()
