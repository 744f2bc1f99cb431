# SPDX-License-Identifier: Apache-2.0
# The target articula_mujoco, if MuJoCo is found, for tests and benchmarks that compare with it. It
# does not use MuJoCo's own CMake package: that of Debian 12 names a folder that does not exist.
find_path(ARTICULA_MUJOCO_INCLUDE_DIR mujoco/mujoco.h)
find_library(ARTICULA_MUJOCO NAMES mujoco)
mark_as_advanced(ARTICULA_MUJOCO_INCLUDE_DIR ARTICULA_MUJOCO)
if(ARTICULA_MUJOCO_INCLUDE_DIR AND ARTICULA_MUJOCO AND NOT TARGET articula_mujoco)
  add_library(articula_mujoco INTERFACE IMPORTED GLOBAL)
  target_include_directories(articula_mujoco SYSTEM INTERFACE ${ARTICULA_MUJOCO_INCLUDE_DIR})
  target_link_libraries(articula_mujoco INTERFACE ${ARTICULA_MUJOCO})
endif()
