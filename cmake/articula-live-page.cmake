# SPDX-License-Identifier: Apache-2.0
# articula_add_live_page(<target> SOURCE <file> [FOLDER <folder>])
#
# A page with a loop inside, as files that need no server: index.html, page.js, page.css and loop.js.
# The source defines articula::live_loop() and is compiled to WebAssembly; see docs/webassembly.md.
# The target articula_live_page makes one of the Q2D in <build>/live. It is not part of `all`. Where a
# tool is missing, the targets say so.

set(articula_live_missing "")
find_program(ARTICULA_WASM_COMPILER NAMES clang++-19)
find_program(ARTICULA_WASM_LINKER NAMES wasm-ld-19)
if(NOT ARTICULA_WASM_COMPILER)
  list(APPEND articula_live_missing clang-19)
endif()
if(NOT ARTICULA_WASM_LINKER)
  list(APPEND articula_live_missing lld-19)
endif()
if(NOT articula_live_missing)
  file(WRITE ${PROJECT_BINARY_DIR}/live-page/empty.cpp "#include <vector>\nint main() {}\n")
  execute_process(
    COMMAND ${ARTICULA_WASM_COMPILER} --target=wasm32-wasi -std=c++20 empty.cpp -o empty.wasm
    WORKING_DIRECTORY ${PROJECT_BINARY_DIR}/live-page
    RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
  if(NOT status EQUAL 0)
    list(APPEND articula_live_missing wasi-libc libclang-rt-19-dev-wasm32 libc++-19-dev-wasm32
         libc++abi-19-dev-wasm32)
  endif()
endif()
find_path(ARTICULA_JSON_INCLUDE nlohmann/json.hpp)
if(NOT ARTICULA_JSON_INCLUDE)
  list(APPEND articula_live_missing nlohmann-json3-dev)
endif()
if(NOT TARGET articula_page)
  list(APPEND articula_live_missing npm)
endif()
if(articula_live_missing)
  list(JOIN articula_live_missing ", " articula_live_missing)
  function(articula_add_live_page target)
    add_custom_target(
      ${target} COMMAND ${CMAKE_COMMAND} -E echo
                        "${target} is left out: it needs ${articula_live_missing}")
  endfunction()
  articula_add_live_page(articula_live_page)
  return()
endif()

# The folder of nlohmann-json alone: beside it are headers of the machine's own C library.
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/live-page/include)
file(CREATE_LINK ${ARTICULA_JSON_INCLUDE}/nlohmann ${PROJECT_BINARY_DIR}/live-page/include/nlohmann
     SYMBOLIC)

# articula_live_object(<variable> <source>): a command that compiles it, and its object.
function(articula_live_object variable source)
  cmake_path(ABSOLUTE_PATH source NORMALIZE)
  string(MD5 name ${source})
  cmake_path(GET source STEM stem)
  set(object ${PROJECT_BINARY_DIR}/live-page/${stem}-${name}.o)
  set(depfile "")
  if(CMAKE_GENERATOR MATCHES "Ninja|Makefiles")
    set(depfile DEPFILE ${object}.d)
  endif()
  add_custom_command(
    OUTPUT ${object}
    COMMAND
      ${CMAKE_CXX_COMPILER_LAUNCHER} ${ARTICULA_WASM_COMPILER} --target=wasm32-wasi -std=c++20 -O2
      -msimd128 -fwasm-exceptions -fconstexpr-steps=1000000000 -I${PROJECT_SOURCE_DIR}/include
      "-isystem$<JOIN:$<TARGET_PROPERTY:Eigen3::Eigen,INTERFACE_INCLUDE_DIRECTORIES>,;-isystem>"
      -isystem${PROJECT_BINARY_DIR}/live-page/include -MD -MF ${object}.d -c ${source} -o ${object}
    DEPENDS ${source} ${depfile}
    COMMENT "Compiling ${stem}.cpp to WebAssembly"
    COMMAND_EXPAND_LISTS VERBATIM)
  set(${variable} ${object} PARENT_SCOPE)
endfunction()

# What every such page has. The server's sources for sockets and files are not among them.
set(articula_live_folder ${PROJECT_SOURCE_DIR}/include/articula/view)
file(GLOB_RECURSE articula_protocol_sources CONFIGURE_DEPENDS ${articula_live_folder}/protocol/*.cpp)
# The protocol is compiled as one file, as articula::view does: most time goes into common headers.
list(TRANSFORM articula_protocol_sources REPLACE "(.+)" "#include \"\\1\"\n"
     OUTPUT_VARIABLE articula_includes)
string(CONCAT articula_includes ${articula_includes})
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/live-page/protocol.cpp CONTENT "${articula_includes}")
file(GLOB articula_live_sources CONFIGURE_DEPENDS ${articula_live_folder}/live/*.cpp)
list(APPEND articula_live_sources ${PROJECT_BINARY_DIR}/live-page/protocol.cpp
     ${articula_live_folder}/server/clients/broadcast.cpp
     ${articula_live_folder}/server/clients/client.cpp
     ${articula_live_folder}/server/clients/latest.cpp
     ${articula_live_folder}/server/futures/futures_desk.cpp
     ${PROJECT_SOURCE_DIR}/examples/webassembly/exceptions.cpp)
set(articula_live_objects "")
foreach(source IN LISTS articula_live_sources)
  articula_live_object(object ${source})
  list(APPEND articula_live_objects ${object})
endforeach()
add_custom_target(articula_live_objects DEPENDS ${articula_live_objects})

function(articula_add_live_page target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "SOURCE;FOLDER" "")
  if(NOT arg_FOLDER)
    set(arg_FOLDER ${PROJECT_BINARY_DIR}/${target})
  endif()
  articula_live_object(object ${arg_SOURCE})
  set(program ${PROJECT_BINARY_DIR}/live-page/${target}.wasm)
  add_custom_command(
    OUTPUT ${program}
    COMMAND ${ARTICULA_WASM_COMPILER} --target=wasm32-wasi -mexec-model=reactor -Wl,--strip-all
            ${object} ${articula_live_objects} -o ${program}
    DEPENDS ${object} ${articula_live_objects} articula_live_objects
    VERBATIM)
  add_custom_command(
    OUTPUT ${arg_FOLDER}/index.html
    COMMAND
      ${CMAKE_COMMAND} -DNPM=${ARTICULA_NPM} -DWORK=${PROJECT_BINARY_DIR}/page-source
      -DPAGE=${arg_FOLDER} -DPROGRAM=${program} -P ${PROJECT_SOURCE_DIR}/cmake/build-live-page.cmake
    DEPENDS ${program} articula_page ${articula_page_files}
            ${PROJECT_SOURCE_DIR}/cmake/build-live-page.cmake
    COMMENT "Putting the loop into a page: ${arg_FOLDER}"
    VERBATIM)
  add_custom_target(${target} DEPENDS ${arg_FOLDER}/index.html)
endfunction()

articula_add_live_page(articula_live_page SOURCE ${PROJECT_SOURCE_DIR}/examples/webassembly/live_q2d.cpp
                       FOLDER ${PROJECT_BINARY_DIR}/live)
