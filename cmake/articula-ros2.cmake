# SPDX-License-Identifier: Apache-2.0
# The component ros2: the target articula::ros2, a library with the bridge to ROS 2 and its transport
# over Fast DDS. The build of articula includes this file, and find_package(articula) includes the installed one; the
# library is compiled where it is used. The target exists only if Fast DDS 2 is found.

find_package(OpenSSL QUIET) # which the package of Fast DDS requires
if(OPENSSL_FOUND)
  find_package(fastrtps 2.9 CONFIG QUIET)
endif()
find_package(Threads QUIET)

if(TARGET fastrtps AND TARGET Threads::Threads)
  if(NOT TARGET articula::ros2)
    # In the sources, and in an installed package.
    set(articula_ros2_folder ${CMAKE_CURRENT_LIST_DIR}/../include/articula/ros2)
    if(NOT EXISTS ${articula_ros2_folder}/dds/fast_dds_transport.cpp)
      set(articula_ros2_folder ${CMAKE_CURRENT_LIST_DIR}/ros2)
    endif()
    file(GLOB_RECURSE articula_ros2_sources CONFIGURE_DEPENDS ${articula_ros2_folder}/node/*.cpp
         ${articula_ros2_folder}/bridge/*.cpp)
    file(GLOB_RECURSE articula_ros2_dds_sources CONFIGURE_DEPENDS ${articula_ros2_folder}/dds/*.cpp)
    add_library(articula_ros2 STATIC EXCLUDE_FROM_ALL ${articula_ros2_sources}
                                                      ${articula_ros2_dds_sources})
    # Reading the headers of messages and of Fast DDS takes most of the time.
    set_source_files_properties(${articula_ros2_sources} PROPERTIES UNITY_GROUP bridge)
    set_source_files_properties(${articula_ros2_dds_sources} PROPERTIES UNITY_GROUP dds)
    set_target_properties(articula_ros2 PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    add_library(articula::ros2 ALIAS articula_ros2)
    target_link_libraries(articula_ros2 PUBLIC articula::articula fastrtps Threads::Threads)
  endif()
else()
  set(articula_ros2_FOUND FALSE)
  set(articula_NOT_FOUND_MESSAGE
      "articula's component ros2 needs Fast DDS 2.9 or later of version 2 (Debian 12: libfastrtps-dev), \
OpenSSL (libssl-dev) and threads")
endif()
