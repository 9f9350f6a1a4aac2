# No function of one instruction set's kernels may be what another's, or the baseline's code, is linked to: on a processor
# without it that would end in SIGILL. So no symbol that the linker may merge (weak, unique) is in two of these objects.
#   cmake -D nm=… -D kernels=a.o,b.o -D others=c.o,d.o -P kernels_apart.cmake
cmake_minimum_required(VERSION 3.25)

function(mergeable_symbols result)
  execute_process(COMMAND "${nm}" --defined-only ${ARGN} OUTPUT_VARIABLE lines COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[0-9a-f]+ [WVu] [^\n]+" lines "${lines}")
  list(TRANSFORM lines REPLACE "^[0-9a-f]+ [WVu] " "")
  list(FILTER lines EXCLUDE REGEX "^DW\\.ref\\.")  # pointers to the exception handler: no code
  set(${result} "${lines}" PARENT_SCOPE)
endfunction()

string(REPLACE "," ";" kernels "${kernels}")
string(REPLACE "," ";" others "${others}")
list(FILTER others INCLUDE REGEX "\\.o(bj)?$")  # not the precompiled header
mergeable_symbols(seen ${others})
foreach(object IN LISTS kernels)
  mergeable_symbols(own "${object}")
  list(LENGTH own count)
  message(STATUS "${object}: ${count} symbols that a linker may merge")
  if(count EQUAL 0)
    message(FATAL_ERROR "found none: is it an object of the kernels?")
  endif()
  foreach(symbol IN LISTS own)
    if(symbol IN_LIST seen)
      message(SEND_ERROR "${object} shares ${symbol}")
    endif()
  endforeach()
  list(APPEND seen ${own})
endforeach()
