# SPDX-License-Identifier: Apache-2.0
# The component socketcan: the target articula::socketcan, on Linux. Read by our own build and,
# installed, by find_package(articula). It needs nothing but the kernel's headers.
if(CMAKE_SYSTEM_NAME STREQUAL Linux)
  if(NOT TARGET articula::socketcan)
    add_library(articula::socketcan INTERFACE IMPORTED GLOBAL)
    target_link_libraries(articula::socketcan INTERFACE articula::articula)
  endif()
else()
  set(articula_socketcan_FOUND FALSE)
  set(articula_NOT_FOUND_MESSAGE "articula's component socketcan needs Linux")
endif()
