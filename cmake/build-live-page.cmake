# SPDX-License-Identifier: Apache-2.0
# cmake -DNPM=<npm> -DWORK=<folder> -DPAGE=<folder> -DPROGRAM=<wasm> -P build-live-page.cmake
#
# Puts the loop of a WebAssembly program into a page. WORK is the source of the page with its packages,
# which build-page.cmake has fetched; without them, as without a network, the page is left out.
if(NOT EXISTS ${WORK}/node_modules/.articula)
  message("${PAGE} is left out, since npm could not fetch the packages of the page.")
  return()
endif()
execute_process(COMMAND ${NPM} run --silent build -- ${PAGE} ${PROGRAM} WORKING_DIRECTORY ${WORK}
                        COMMAND_ERROR_IS_FATAL ANY)
