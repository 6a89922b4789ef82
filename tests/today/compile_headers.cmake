# cmake -DCOMPILER=... -DSOURCE_DIR=... -DMUJOCO=<include folder> -DEIGEN=... -DWORK_DIR=... -P compile_headers.cmake
# Reads every source that may include mujoco.h with the headers of one MuJoCo, without making code.
file(GLOB sources "${SOURCE_DIR}/plugin/*.cc" "${SOURCE_DIR}/plugin/*/*.cc" "${SOURCE_DIR}/compare/engine/*.cc"
     "${SOURCE_DIR}/renders/*.cc")
list(LENGTH sources count)
if(count LESS 40)
  message(FATAL_ERROR "only ${count} sources below ${SOURCE_DIR}")
endif()
set(flags -std=c++20 -Wall -Wextra -Wconversion -Wformat=2 -Werror -I "${SOURCE_DIR}" -isystem "${EIGEN}" -isystem
          "${MUJOCO}")

# What all of them read, once.
file(MAKE_DIRECTORY "${WORK_DIR}")
file(WRITE "${WORK_DIR}/all.h" "#include <Eigen/Dense>\n#include <algorithm>\n#include <functional>\n#include <memory>\n"
                               "#include <sstream>\n#include <vector>\n#include <mujoco/mujoco.h>\n"
                               "#include \"plugin/config.h\"\n#include \"plugin/mujoco_versions.h\"\n")
execute_process(COMMAND "${COMPILER}" ${flags} -x c++-header "${WORK_DIR}/all.h" -o "${WORK_DIR}/all.h.gch"
                        COMMAND_ERROR_IS_FATAL ANY)

# Two at a time, by xargs.
list(JOIN sources "\n" names)
execute_process(
  COMMAND sh -c "printf '%s\\n' \"$0\" | xargs -P 2 -n 8 \"$@\"" "${names}" "${COMPILER}" ${flags}
          -fsyntax-only -include "${WORK_DIR}/all.h"
  RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "does not compile against ${MUJOCO}")
endif()
