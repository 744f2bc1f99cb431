# SPDX-License-Identifier: Apache-2.0
# The component socketcan: the target articula::socketcan, on Linux. The build of articula includes
# this file, and find_package(articula) includes the installed one. It needs only the kernel's
# headers.
if(CMAKE_SYSTEM_NAME STREQUAL Linux)
  if(NOT TARGET articula::socketcan)
    add_library(articula::socketcan INTERFACE IMPORTED GLOBAL)
    target_link_libraries(articula::socketcan INTERFACE articula::articula)
  endif()
else()
  set(articula_socketcan_FOUND FALSE)
  set(articula_NOT_FOUND_MESSAGE "articula's component socketcan needs Linux")
endif()
