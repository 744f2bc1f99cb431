# SPDX-License-Identifier: Apache-2.0
# The component config: the target articula::config, for the headers that read YAML. Read by our own
# build and, installed, by find_package(articula). Without yaml-cpp there is no such target. The name
# of this file is longer than its siblings': CMake would take articula-config.cmake for the package.

find_package(yaml-cpp CONFIG QUIET)

# yaml-cpp 0.8 gave its target a namespace.
if(TARGET yaml-cpp::yaml-cpp)
  set(articula_yaml_cpp yaml-cpp::yaml-cpp)
else()
  set(articula_yaml_cpp yaml-cpp)
endif()

if(TARGET ${articula_yaml_cpp})
  if(NOT TARGET articula::config)
    add_library(articula::config INTERFACE IMPORTED GLOBAL)
    target_link_libraries(articula::config INTERFACE articula::articula ${articula_yaml_cpp})
  endif()
else()
  set(articula_config_FOUND FALSE)
  set(articula_NOT_FOUND_MESSAGE
      "articula's component config needs yaml-cpp (Debian: libyaml-cpp-dev)")
endif()
