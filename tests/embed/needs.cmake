# What mis::core drags in: a program that holds all of its archive, linked to nothing else, needs the C++ runtime alone.
#     cmake -D compiler=… -D flags=… -D readelf=… -D library=libmis_core.a -D work=FOLDER -P needs.cmake
set(allowed "^(libc|libm|libstdc\\+\\+|libc\\+\\+|libgcc_s|ld-linux[-a-z0-9_]*|libasan|libubsan)\\.so")

file(MAKE_DIRECTORY "${work}")
file(WRITE "${work}/nothing.cpp" "int main() {}\n")
separate_arguments(options UNIX_COMMAND "${flags}")
execute_process(COMMAND "${compiler}" ${options} "${work}/nothing.cpp" -Wl,--whole-archive "${library}" -Wl,--no-whole-archive
  -o "${work}/all_of_core" RESULT_VARIABLE failed ERROR_VARIABLE said)
if(failed)
  message(FATAL_ERROR "mis::core calls what neither it nor the C++ runtime has:\n${said}")
endif()
execute_process(COMMAND "${readelf}" -d "${work}/all_of_core" OUTPUT_VARIABLE dynamic COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE "[" "<" dynamic "${dynamic}") # which holds a list together
string(REGEX MATCHALL "NEEDED[^\n]*<[^]]*" lines "${dynamic}")
if(NOT lines)
  message(FATAL_ERROR "readelf names no library, not even libc:\n${dynamic}")
endif()
foreach(line IN LISTS lines)
  string(REGEX REPLACE ".*<" "" needed "${line}")
  if(NOT needed MATCHES "${allowed}")
    message(FATAL_ERROR "mis::core needs ${needed}")
  endif()
  message(STATUS "mis::core needs ${needed}")
endforeach()
