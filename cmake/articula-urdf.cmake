# SPDX-License-Identifier: Apache-2.0
# The component urdf: the target articula::urdf and the function articula_add_robot. The build of
# articula includes this file, and find_package(articula) includes the installed one. The target
# exists only if urdfdom is found.

find_package(urdfdom CONFIG QUIET)
find_package(console_bridge CONFIG QUIET)

# urdfdom 4 uses TinyXML-2, older versions TinyXML. The header shows which one.
find_path(
  ARTICULA_URDF_PARSER_INCLUDE_DIR urdf_parser/urdf_parser.h
  HINTS ${urdfdom_INCLUDE_DIRS}
  PATH_SUFFIXES urdfdom)
mark_as_advanced(ARTICULA_URDF_PARSER_INCLUDE_DIR)
if(ARTICULA_URDF_PARSER_INCLUDE_DIR)
  file(STRINGS ${ARTICULA_URDF_PARSER_INCLUDE_DIR}/urdf_parser/urdf_parser.h articula_tinyxml2
       REGEX "tinyxml2")
  if(articula_tinyxml2)
    find_library(ARTICULA_TINYXML NAMES tinyxml2)
  else()
    find_library(ARTICULA_TINYXML NAMES tinyxml)
  endif()
  mark_as_advanced(ARTICULA_TINYXML)
endif()

if(TARGET urdfdom::urdfdom_model AND TARGET console_bridge::console_bridge AND ARTICULA_TINYXML)
  if(NOT TARGET articula::urdf)
    add_library(articula::urdf INTERFACE IMPORTED GLOBAL)
    target_include_directories(articula::urdf SYSTEM INTERFACE ${ARTICULA_URDF_PARSER_INCLUDE_DIR})
    target_link_libraries(
      articula::urdf INTERFACE articula::articula urdfdom::urdfdom_model
                               console_bridge::console_bridge ${ARTICULA_TINYXML})
  endif()
else()
  set(articula_urdf_FOUND FALSE)
  set(articula_NOT_FOUND_MESSAGE
      "articula's component urdf needs urdfdom, console_bridge, TinyXML (Debian: liburdfdom-dev)")
endif()

include(${CMAKE_CURRENT_LIST_DIR}/articula_add_robot.cmake)
