# SPDX-License-Identifier: Apache-2.0
# The component config: the target articula::config, for the headers that read YAML. The build of
# articula includes this file, and find_package(articula) includes the installed one. The target
# exists only if yaml-cpp is found. The file's name contains "component" because CMake would read
# articula-config.cmake as the package itself.

find_package(yaml-cpp CONFIG QUIET)

# The target has a namespace since yaml-cpp 0.8.
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
