# cmake -DBUILD_DIR=... -DOUTSIDE_DIR=... -DEXAMPLE_DIR=... -DWORK_DIR=... -DEVERY=<ON or OFF> -P outside_project.cmake
# Installs the build into a new folder, and builds and runs the projects in OUTSIDE_DIR and EXAMPLE_DIR with it. EVERY=ON
# compiles every public header by itself, otherwise every third.
file(REMOVE_RECURSE "${WORK_DIR}")
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BUILD_DIR}" --prefix "${WORK_DIR}/prefix"
                        COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
execute_process(
  COMMAND "${CMAKE_COMMAND}" -G Ninja -S "${OUTSIDE_DIR}" -B "${WORK_DIR}/build"
          "-DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix" "-DEVERY=${EVERY}" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CMAKE_COMMAND}" --build "${WORK_DIR}/build" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${WORK_DIR}/build/outside"
                        "${WORK_DIR}/prefix/share/rotorub/mjcf/bench_ring.toml"
                        "${WORK_DIR}/outside.xml" COMMAND_ERROR_IS_FATAL ANY)

# The example of native_model/examples/README.md prints the published first impacts of bench_ring.
execute_process(
  COMMAND "${CMAKE_COMMAND}" -G Ninja -S "${EXAMPLE_DIR}" -B "${WORK_DIR}/example"
          "-DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CMAKE_COMMAND}" --build "${WORK_DIR}/example" COMMAND_ERROR_IS_FATAL ANY)
execute_process(
  COMMAND "${WORK_DIR}/example/first_impacts" "${WORK_DIR}/prefix/share/rotorub/mjcf/bench_ring.toml"
  OUTPUT_VARIABLE impacts COMMAND_ERROR_IS_FATAL ANY)
foreach(time 4.0601 7.5981 8.9758 9.5869 9.8768)
  if(NOT impacts MATCHES "${time} ms")
    message(SEND_ERROR "the example misses the impact at ${time} ms:\n${impacts}")
  endif()
endforeach()

# No installed file may contain a path of the build or the source.
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
