# SPDX-License-Identifier: Apache-2.0
# The target articula_page: the page of the view, made from include/articula/view/page with npm into
# <build>/page, where View finds it. Without npm or its packages the page is left out, and the rest
# is built. In a project that contains articula, it is made where something links articula::view.

find_program(ARTICULA_NPM npm DOC "Node's package manager, for the page of the view")
set(articula_page_source ${PROJECT_SOURCE_DIR}/include/articula/view/page)
if(NOT ARTICULA_NPM)
  message(STATUS "The page of the view is not built; it needs Node.js and npm "
                 "(cmake/install-dependencies.sh --view). The view works without it.")
  return()
endif()

file(GLOB_RECURSE articula_page_files CONFIGURE_DEPENDS ${articula_page_source}/src/*
     ${articula_page_source}/mock/*)
list(APPEND articula_page_files ${articula_page_source}/build.mjs
     ${articula_page_source}/package.json ${articula_page_source}/package-lock.json)
set(articula_page_stamp ${PROJECT_BINARY_DIR}/page.stamp)
add_custom_command(
  OUTPUT ${articula_page_stamp}
  COMMAND
    ${CMAKE_COMMAND} -DNPM=${ARTICULA_NPM} -DSOURCE=${articula_page_source}
    -DWORK=${PROJECT_BINARY_DIR}/page-source -DPAGE=${PROJECT_BINARY_DIR}/page
    -DSTAMP=${articula_page_stamp} -P ${PROJECT_SOURCE_DIR}/cmake/build-page.cmake
  DEPENDS ${articula_page_files} ${PROJECT_SOURCE_DIR}/cmake/build-page.cmake
  COMMENT "Building the page of the view"
  VERBATIM)
if(PROJECT_IS_TOP_LEVEL)
  add_custom_target(articula_page ALL DEPENDS ${articula_page_stamp})
else()
  add_custom_target(articula_page DEPENDS ${articula_page_stamp})
  add_dependencies(articula_view articula_page)
endif()
if(ARTICULA_INSTALL)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/page DESTINATION ${CMAKE_INSTALL_DATADIR}/articula OPTIONAL)
endif()
