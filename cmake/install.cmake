# SPDX-License-Identifier: Apache-2.0
# Installs the headers and the CMake package for find_package(articula).
include(CMakePackageConfigHelpers)

set(articula_package_dir ${CMAKE_INSTALL_DATADIR}/cmake/articula)

install(TARGETS articula EXPORT articula FILE_SET HEADERS)
install(
  EXPORT articula
  FILE articulaTargets.cmake
  NAMESPACE articula::
  DESTINATION ${articula_package_dir})

configure_package_config_file(
  cmake/articulaConfig.cmake.in ${PROJECT_BINARY_DIR}/articulaConfig.cmake
  INSTALL_DESTINATION ${articula_package_dir}
  NO_SET_AND_CHECK_MACRO)
# Before 1.0 a new minor version may break its users. The headers do not depend on the architecture.
write_basic_package_version_file(
  ${PROJECT_BINARY_DIR}/articulaConfigVersion.cmake
  COMPATIBILITY SameMinorVersion
  ARCH_INDEPENDENT)
install(
  FILES ${PROJECT_BINARY_DIR}/articulaConfig.cmake ${PROJECT_BINARY_DIR}/articulaConfigVersion.cmake
  DESTINATION ${articula_package_dir})

# The component urdf, with the source of the program that makes a header of a URDF.
install(FILES cmake/articula-urdf.cmake cmake/articula_add_robot.cmake
        DESTINATION ${articula_package_dir})
install(DIRECTORY cmake/urdf_to_robot DESTINATION ${articula_package_dir})

# The component socketcan.
install(FILES cmake/articula-socketcan.cmake DESTINATION ${articula_package_dir})

# The component sweep.
install(FILES cmake/articula-sweep.cmake DESTINATION ${articula_package_dir})

# The component recording.
install(FILES cmake/articula-recording.cmake DESTINATION ${articula_package_dir})

# The component view, with the source of its server.
install(FILES cmake/articula-view.cmake DESTINATION ${articula_package_dir})
install(
  DIRECTORY include/articula/view/protocol include/articula/view/server
  DESTINATION ${articula_package_dir}/view
  FILES_MATCHING
  PATTERN "*.cpp")

# The component ros2, with its sources.
install(FILES cmake/articula-ros2.cmake DESTINATION ${articula_package_dir})
install(
  DIRECTORY include/articula/ros2/node include/articula/ros2/bridge include/articula/ros2/dds
  DESTINATION ${articula_package_dir}/ros2
  FILES_MATCHING
  PATTERN "*.cpp")

# The component config.
install(FILES cmake/articula-component-config.cmake DESTINATION ${articula_package_dir})

# The files that README.md and docs link to, in the same folders as here. Headers are the exception:
# they are in the folder of headers.
install(FILES README.md CHANGELOG.md CONTRIBUTING.md CITATION.cff LICENSE TYPE DOC)
install(DIRECTORY docs TYPE DOC)
install(DIRECTORY examples TYPE DOC PATTERN CMakeLists.txt EXCLUDE) # part of articula's build
install(DIRECTORY benchmarks/results DESTINATION ${CMAKE_INSTALL_DOCDIR}/benchmarks)
