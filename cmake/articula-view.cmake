# SPDX-License-Identifier: Apache-2.0
# The component view: the target articula::view, a library with the server of View. The build of
# articula includes this file, and find_package(articula) includes the installed one; the library is
# compiled where it is used. The target exists only if Boost and nlohmann-json are found.

find_package(Boost 1.81 QUIET)
find_package(nlohmann_json 3.10 CONFIG QUIET)
find_package(Threads QUIET)

if(TARGET Boost::headers AND TARGET nlohmann_json::nlohmann_json AND TARGET Threads::Threads)
  if(NOT TARGET articula::view)
    # In the sources, and in an installed package.
    set(articula_view_folder ${CMAKE_CURRENT_LIST_DIR}/../include/articula/view)
    set(articula_view_page ${PROJECT_BINARY_DIR}/page)
    if(NOT EXISTS ${articula_view_folder}/server/server.cpp)
      set(articula_view_folder ${CMAKE_CURRENT_LIST_DIR}/view)
      set(articula_view_page ${CMAKE_CURRENT_LIST_DIR}/../../articula/page)
    endif()
    cmake_path(NORMAL_PATH articula_view_page)

    file(GLOB_RECURSE articula_view_protocol_sources CONFIGURE_DEPENDS
         ${articula_view_folder}/protocol/*.cpp)
    file(GLOB_RECURSE articula_view_server_sources CONFIGURE_DEPENDS ${articula_view_folder}/server/*.cpp)
    add_library(articula_view STATIC EXCLUDE_FROM_ALL ${articula_view_protocol_sources}
                                                      ${articula_view_server_sources})
    # Reading the headers of JSON and of Boost takes most of the time.
    set_source_files_properties(${articula_view_protocol_sources} PROPERTIES UNITY_GROUP protocol)
    set_source_files_properties(${articula_view_server_sources} PROPERTIES UNITY_GROUP server)
    set_target_properties(articula_view PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    add_library(articula::view ALIAS articula_view)
    target_compile_definitions(articula_view PRIVATE ARTICULA_VIEW_PAGE="${articula_view_page}")
    target_link_libraries(articula_view PUBLIC articula::articula Boost::headers
                                               nlohmann_json::nlohmann_json Threads::Threads)
  endif()
else()
  set(articula_view_FOUND FALSE)
  set(articula_NOT_FOUND_MESSAGE
      "articula's component view needs Boost 1.81 (Debian 12: libboost1.81-dev, later: libboost-dev), \
nlohmann-json (nlohmann-json3-dev) and threads")
endif()
