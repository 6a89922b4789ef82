# cmake -DFILES=<file>,<file>... -P own_math.cmake
# No program or library of ours asks the C library for functions whose last bit it chooses by the processor, and
# none shows its own to whoever it is loaded with.
set(functions
    sin cos sincos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh
    exp exp2 exp10 expm1 log log2 log10 log1p pow cbrt hypot cabs carg csqrt)
string(REPLACE "," ";" files "${FILES}")
foreach(file IN LISTS files)
  execute_process(
    COMMAND nm --dynamic "${file}"
    OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  if(NOT symbols MATCHES "GLIBC")
    message(FATAL_ERROR "${file} names nothing of the C library in\n${symbols}")
  endif()
  foreach(function IN LISTS functions)
    if(symbols MATCHES "[^\n]* ${function}(@[^\n]*)?\n")
      message(SEND_ERROR "${file}: ${CMAKE_MATCH_0}")
    endif()
  endforeach()
endforeach()
