# cmake -DLIBRARY=... -P preload_needs.cmake
set(ENV{LC_ALL} C)
execute_process(
  COMMAND readelf --dynamic --wide "${LIBRARY}"
  OUTPUT_VARIABLE dynamic COMMAND_ERROR_IS_FATAL ANY)
# An unbalanced bracket would join the elements of a list.
string(REGEX REPLACE "[][]" "" dynamic "${dynamic}")
string(REGEX MATCHALL "Shared library: [^\n]+" needed "${dynamic}")
if(NOT needed)
  message(FATAL_ERROR "no library at all is named in\n${dynamic}")
endif()
foreach(entry IN LISTS needed)
  string(REPLACE "Shared library: " "" library "${entry}")
  if(NOT library MATCHES "^(libmujoco|libstdc\\+\\+|libgcc_s|libc|libm|ld-linux[^.]*)\\.so")
    message(SEND_ERROR "${LIBRARY} needs ${library}")
  endif()
endforeach()

# An exported symbol could replace one of the program into which the library is loaded.
execute_process(
  COMMAND nm --dynamic --defined-only --demangle "${LIBRARY}"
  OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCH "[^\n]*rotorub::[^\n]*" shown "${symbols}")
if(shown)
  message(SEND_ERROR "${LIBRARY} shows ${shown}")
endif()
