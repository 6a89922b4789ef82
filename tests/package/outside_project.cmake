# cmake -DBUILD_DIR=... -DOUTSIDE_DIR=... -DWORK_DIR=... -P outside_project.cmake
# Installs the build into a fresh folder, and builds and runs the project in OUTSIDE_DIR against that.
file(REMOVE_RECURSE "${WORK_DIR}")
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BUILD_DIR}" --prefix "${WORK_DIR}/prefix"
                        COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
execute_process(
  COMMAND "${CMAKE_COMMAND}" -G Ninja -S "${OUTSIDE_DIR}" -B "${WORK_DIR}/build"
          "-DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CMAKE_COMMAND}" --build "${WORK_DIR}/build" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${WORK_DIR}/build/outside"
                        "${WORK_DIR}/prefix/share/rotorub/mjcf/bench_ring.toml"
                        COMMAND_ERROR_IS_FATAL ANY)

# Nothing that was installed may lead back to the build or the source.
file(GLOB package "${WORK_DIR}/prefix/lib*/cmake/rotorub/*.cmake"
     "${WORK_DIR}/prefix/lib*/*/cmake/rotorub/*.cmake")
if(NOT package)
  message(FATAL_ERROR "no CMake package was installed")
endif()
foreach(file IN LISTS package)
  file(READ "${file}" text)
  string(FIND "${text}" "${BUILD_DIR}" position)
  if(NOT position EQUAL -1)
    message(SEND_ERROR "${file} names the build folder")
  endif()
endforeach()
