# cmake -DCOMPILER=... -DSOURCE_DIR=... -DMUJOCO=<include folder> -DEIGEN=... -P compile_headers.cmake
# Reads every source that may include mujoco.h with the headers of one MuJoCo, without making code.
file(GLOB sources "${SOURCE_DIR}/plugin/*.cc" "${SOURCE_DIR}/plugin/*/*.cc" "${SOURCE_DIR}/compare/engine/*.cc"
     "${SOURCE_DIR}/renders/*.cc")
list(LENGTH sources count)
if(count LESS 40)
  message(FATAL_ERROR "only ${count} sources below ${SOURCE_DIR}")
endif()
list(JOIN sources "\n" names)
# Two at a time: this is read by xargs.
execute_process(
  COMMAND sh -c "printf '%s\\n' \"$0\" | xargs -P 2 -n 8 \"$@\"" "${names}" "${COMPILER}" -std=c++20 -fsyntax-only
          -Wall -Wextra -Wconversion -Wformat=2 -Werror -I "${SOURCE_DIR}" -isystem "${EIGEN}" -isystem "${MUJOCO}"
  RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "does not compile against ${MUJOCO}")
endif()
