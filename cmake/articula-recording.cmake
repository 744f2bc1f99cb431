# SPDX-License-Identifier: Apache-2.0
# The component recording: the target articula::recording, for the headers that write JSON. The
# build of articula includes this file, and find_package(articula) includes the installed one. The
# target exists only if nlohmann-json is found.

find_package(nlohmann_json 3.10 CONFIG QUIET)
find_package(Threads QUIET)

if(TARGET nlohmann_json::nlohmann_json AND TARGET Threads::Threads)
  if(NOT TARGET articula::recording)
    add_library(articula::recording INTERFACE IMPORTED GLOBAL)
    target_link_libraries(
      articula::recording INTERFACE articula::articula nlohmann_json::nlohmann_json
                                    Threads::Threads)
  endif()
else()
  set(articula_recording_FOUND FALSE)
  set(articula_NOT_FOUND_MESSAGE
      "articula's component recording needs nlohmann-json (Debian: nlohmann-json3-dev) and threads")
endif()
