# An object compiled for one instruction set defines, beside code of its own width (Lane<...>), nothing that
# another object could share: the linker would keep one of the two, and an older processor could not run it.
execute_process(COMMAND "${NM}" -C --defined-only "${OBJECT}" OUTPUT_VARIABLE symbols
                COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE "\n" ";" symbols "${symbols}")
list(FILTER symbols INCLUDE REGEX " [WVu] ")
list(FILTER symbols EXCLUDE REGEX "Lane<")
if(symbols)
  message(FATAL_ERROR "${OBJECT} shares with other objects:\n${symbols}")
endif()
