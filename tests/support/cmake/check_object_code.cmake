# SPDX-License-Identifier: Apache-2.0
# cmake -DNM= -DOBJECT= -DALLOW= -P check_object_code.cmake
# Fails unless OBJECT defines a function and refers to nothing but the symbols allowed here.

set(allowed
    _GLOBAL_OFFSET_TABLE_
    __stack_chk_fail
    "mem(cpy|set|move|cmp)"
    bcmp # what clang makes of a memcmp that is asked for equality
    # libm: sinl, sin, sinf and so on
    "(sin|cos|sincos|tan|asin|acos|atan|atan2|sinh|cosh|tanh)[fl]?"
    "(exp|exp2|expm1|log|log2|log10|log1p)[fl]?"
    "(sqrt|cbrt|frexp|ldexp|pow|hypot|fma|fmod|remainder|fmin|fmax|fabs|copysign)[fl]?"
    "(floor|ceil|trunc|round|lround|llround|rint|lrint|llrint|nearbyint|nextafter)[fl]?"
    # g++ notes in the tables of a noexcept function that nothing leaves it. To throw takes
    # __cxa_throw, to catch __cxa_begin_catch, to give up std::terminate; none of these is allowed.
    __gxx_personality_v0
    ${ALLOW})

function(symbols variable)
  execute_process(
    COMMAND ${NM} -P ${ARGN} ${OBJECT}
    OUTPUT_VARIABLE output
    OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "\n" ";" lines "${output}")
  set(${variable} ${lines} PARENT_SCOPE)
endfunction()

# In the portable format a line is "name type ...".
symbols(defined --defined-only)
list(FILTER defined INCLUDE REGEX " [TW] ")
if(NOT defined)
  message(FATAL_ERROR "no function in ${OBJECT}: nothing would be checked")
endif()

symbols(undefined --undefined-only)
list(TRANSFORM undefined REPLACE " .*" "")
foreach(regex IN LISTS allowed)
  list(FILTER undefined EXCLUDE REGEX "^(${regex})$")
endforeach()
if(undefined)
  list(SORT undefined)
  list(JOIN undefined " " names)
  message(FATAL_ERROR "symbols that have no place in a control loop: ${names}")
endif()
