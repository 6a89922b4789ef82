# cmake -DCOMPILER=... -DSOURCE_DIR=... -DMUJOCO=<include folder> "-DINCLUDES=<other libraries' include folders>" -DWORK_DIR=... -P compile_headers.cmake
# Reads every source that may include mujoco.h with the headers of one MuJoCo, without making code: the files of a
# folder as one unit, as they are built (RotorubUnity).
file(GLOB_RECURSE sources "${SOURCE_DIR}/plugin/*.cc" "${SOURCE_DIR}/compare/engine/*.cc" "${SOURCE_DIR}/renders/*.cc")
list(LENGTH sources count)
if(count LESS 50)
  message(FATAL_ERROR "only ${count} sources below ${SOURCE_DIR}")
endif()
set(units "")
foreach(source IN LISTS sources)
  cmake_path(GET source PARENT_PATH folder)
  cmake_path(RELATIVE_PATH folder BASE_DIRECTORY "${SOURCE_DIR}")
  string(MAKE_C_IDENTIFIER "${folder}" folder)
  list(APPEND units "${WORK_DIR}/${folder}.cc")
  string(APPEND text_${folder} "#include \"${source}\"\n")
endforeach()
list(REMOVE_DUPLICATES units)
file(REMOVE_RECURSE "${WORK_DIR}")
foreach(unit IN LISTS units)
  cmake_path(GET unit STEM folder)
  file(WRITE "${unit}" "${text_${folder}}")
endforeach()

set(flags -std=c++20 -Wall -Wextra -Wconversion -Wformat=2 -Werror -I "${SOURCE_DIR}")
foreach(include IN LISTS INCLUDES MUJOCO)
  list(APPEND flags -isystem "${include}")
endforeach()

# What all of them read, once.
file(WRITE "${WORK_DIR}/all.h" "#include <Eigen/Dense>\n#include <algorithm>\n#include <functional>\n#include <memory>\n"
                               "#include <sstream>\n#include <vector>\n#include <mujoco/mujoco.h>\n"
                               "#include \"plugin/config.h\"\n#include \"plugin/mujoco_versions.h\"\n")
execute_process(COMMAND "${COMPILER}" ${flags} -x c++-header "${WORK_DIR}/all.h" -o "${WORK_DIR}/all.h.gch"
                        COMMAND_ERROR_IS_FATAL ANY)

# Two at a time, by xargs.
list(JOIN units "\n" names)
execute_process(
  COMMAND sh -c "printf '%s\\n' \"$0\" | xargs -P 2 -n 1 \"$@\"" "${names}" "${COMPILER}" ${flags}
          -fsyntax-only -include "${WORK_DIR}/all.h"
  RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "does not compile against ${MUJOCO}")
endif()
