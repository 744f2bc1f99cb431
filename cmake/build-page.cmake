# SPDX-License-Identifier: Apache-2.0
# cmake -DNPM=<npm> -DSOURCE=<folder> -DWORK=<folder> -DPAGE=<folder> -DSTAMP=<file> -P build-page.cmake
#
# Builds the page of the view in a copy of its source, so that the sources stay as they are. If a step
# fails, as without a network, it says so and the build goes on without the page.

file(MAKE_DIRECTORY ${WORK})
file(REMOVE_RECURSE ${WORK}/src)
file(COPY ${SOURCE}/ DESTINATION ${WORK} PATTERN node_modules EXCLUDE PATTERN dist EXCLUDE)

function(run)
  execute_process(
    COMMAND ${ARGN}
    WORKING_DIRECTORY ${WORK}
    RESULT_VARIABLE status
    OUTPUT_VARIABLE output
    ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message("${output}")
    message("The page of the view is left out, since this failed: ${command}")
    set(failed TRUE PARENT_SCOPE)
  endif()
endfunction()

# The packages are those of the lock file; they are fetched again only when it changes.
file(SHA256 ${WORK}/package-lock.json wanted)
set(installed "")
if(EXISTS ${WORK}/node_modules/.articula)
  file(READ ${WORK}/node_modules/.articula installed)
endif()
if(NOT installed STREQUAL wanted)
  run(${NPM} ci --no-audit --no-fund --ignore-scripts)
  if(failed)
    return()
  endif()
  file(WRITE ${WORK}/node_modules/.articula ${wanted})
endif()

run(${NPM} run --silent build -- ${PAGE})
if(NOT failed)
  file(TOUCH ${STAMP})
endif()
