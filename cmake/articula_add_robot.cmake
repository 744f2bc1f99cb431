# SPDX-License-Identifier: Apache-2.0

# articula_add_robot(<Name> URDF <file> [ROOT <link>] [TIP <link>] [NAMESPACE <namespace>]
#                    [LOCK <joint>[=<position>]...] [GRAVITY <x> <y> <z>]
#                    [RIGHT_ANGLE_TOLERANCE <number>] [ALLOW_UNPHYSICAL] [KINEMATIC])
#
# Defines an INTERFACE target <Name> with the header <name>.hpp. The header's name is in snake case:
# LbrIiwa is in lbr_iiwa.hpp. It defines `struct <Name>`, in the namespace if there is one, with the
# robot as a constexpr RobotDescription. The build makes the header again when the URDF changes. A
# URDF with an error stops the build with the element, the reason and the figures.
#
#   ROOT              the link that becomes the fixed base. Default: the URDF's root
#   TIP               the last link of a chain from the root. The rest is left out with its mass,
#                     with a warning if joints of the chain carry it
#   NAMESPACE         the namespace of the struct. Default: none
#   LOCK              joints held at 0 or at a position [rad or m], with a warning beyond the
#                     joint's limits. Joints that mimic one of them are held, too
#   GRAVITY           acceleration of free fall in the root link's frame [m/s^2]. Default: 0 0 -9.81
#   RIGHT_ANGLE_TOLERANCE  tolerance for right angles written with few digits: the largest
#                     difference of a rotation's element from 0, 1 and -1, for dynamics. Default:
#                     1e-7. 0 leaves every angle as written. The largest value is 0.1
#   ALLOW_UNPHYSICAL  accepts inertias that no real body has, with a warning for each
#   KINEMATIC         omits all masses: the robot has kinematics and no dynamics. For files
#                     without masses
#
# The build also builds the program that reads the URDF, for the build machine. When
# cross-compiling, set ARTICULA_URDF_TO_ROBOT to the path of such a program.
function(articula_add_robot name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "ALLOW_UNPHYSICAL;KINEMATIC"
                        "URDF;ROOT;TIP;NAMESPACE;RIGHT_ANGLE_TOLERANCE" "LOCK;GRAVITY")
  if(DEFINED arg_UNPARSED_ARGUMENTS) # DEFINED, because the argument may be the text OFF
    message(FATAL_ERROR "articula_add_robot(${name}): unknown argument ${arg_UNPARSED_ARGUMENTS}; "
                        "expected one of URDF, ROOT, TIP, NAMESPACE, LOCK, GRAVITY, "
                        "RIGHT_ANGLE_TOLERANCE, ALLOW_UNPHYSICAL, KINEMATIC")
  endif()
  if(DEFINED arg_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "articula_add_robot(${name}): ${arg_KEYWORDS_MISSING_VALUES} has no value; "
                        "add one")
  endif()
  if(NOT arg_URDF)
    message(FATAL_ERROR "articula_add_robot(${name}): the argument URDF <file> is missing; add it")
  endif()
  if(NOT name MATCHES "^[A-Za-z][A-Za-z0-9_]*$")
    message(FATAL_ERROR "articula_add_robot(${name}): '${name}' cannot be the name of a struct; "
                        "expected a letter, then letters, digits and _")
  endif()
  if(TARGET ${name} OR TARGET ${name}_header)
    message(FATAL_ERROR "articula_add_robot(${name}): a target ${name} or ${name}_header exists; "
                        "choose another name")
  endif()
  set(urdf ${arg_URDF})
  cmake_path(ABSOLUTE_PATH urdf BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} NORMALIZE)
  get_source_file_property(generated ${urdf} GENERATED)
  if(NOT generated AND NOT EXISTS ${urdf})
    message(FATAL_ERROR "articula_add_robot(${name}): the file ${urdf} does not exist")
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
      message(FATAL_ERROR "articula_add_robot(${name}): GRAVITY is '${arg_GRAVITY}', "
                          "expected x y z")
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
  # ALL: a URDF with an error stops a whole build even if no target links the robot.
  add_custom_target(${name}_header ALL DEPENDS ${header})
  add_library(${name} INTERFACE)
  add_dependencies(${name} ${name}_header)
  target_include_directories(${name} INTERFACE ${directory})
  target_link_libraries(${name} INTERFACE articula::articula)
endfunction()

# Sets the variable to the target or the file of the program that reads URDFs.
function(articula_urdf_to_robot variable)
  set(ARTICULA_URDF_TO_ROBOT "" CACHE FILEPATH "urdf_to_robot for the build machine")
  mark_as_advanced(ARTICULA_URDF_TO_ROBOT)
  if(ARTICULA_URDF_TO_ROBOT)
    set(${variable} ${ARTICULA_URDF_TO_ROBOT} PARENT_SCOPE)
    return()
  endif()
  if(NOT TARGET articula::urdf)
    message(FATAL_ERROR "articula_add_robot needs urdfdom, which was not found; install it "
                        "(Debian: liburdfdom-dev)")
  endif()
  if(CMAKE_CROSSCOMPILING)
    message(FATAL_ERROR "articula_add_robot cannot build urdf_to_robot when cross-compiling; set "
                        "ARTICULA_URDF_TO_ROBOT to the path of one for this machine")
  endif()
  if(NOT TARGET articula_urdf_to_robot)
    set(source ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/urdf_to_robot)
    add_executable(articula_urdf_to_robot EXCLUDE_FROM_ALL ${source}/urdf_to_robot.cpp
                                                           ${source}/header_text.cpp)
    target_link_libraries(articula_urdf_to_robot PRIVATE articula::urdf)
  endif()
  set(${variable} articula_urdf_to_robot PARENT_SCOPE)
endfunction()
