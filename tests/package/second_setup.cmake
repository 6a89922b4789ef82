# cmake -DSOURCE_DIR=... -DWORK_DIR=... -P second_setup.cmake
# Runs compare/setup with replacements of apt-get, npm and sudo that leave a trace and fail.
file(REMOVE_RECURSE "${WORK_DIR}")
file(MAKE_DIRECTORY "${WORK_DIR}/bin")
foreach(command apt-get npm sudo)
  file(WRITE "${WORK_DIR}/bin/${command}" "#!/bin/sh\necho ${command} >>'${WORK_DIR}/called'\nexit 1\n")
  file(CHMOD "${WORK_DIR}/bin/${command}" PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
endforeach()

set(ENV{PATH} "${WORK_DIR}/bin:$ENV{PATH}")
execute_process(
  COMMAND "${SOURCE_DIR}/compare/setup"
  RESULT_VARIABLE code
  OUTPUT_VARIABLE output
  ERROR_VARIABLE output)
if(EXISTS "${WORK_DIR}/called")
  file(READ "${WORK_DIR}/called" called)
  message(FATAL_ERROR "the set-up called ${called}${output}")
endif()
if(NOT code EQUAL 0 OR NOT output STREQUAL "")
  message(FATAL_ERROR "exit code ${code}, output: ${output}")
endif()
