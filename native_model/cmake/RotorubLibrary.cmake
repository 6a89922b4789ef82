# rotorub_library(<name> [FOLDER <folder>] [EXCLUDE <regex>] [PUBLIC <target>...] [PRIVATE <target>...])
#
# The static library of the current folder, or of FOLDER in it: every .cc below it but main.cc and what EXCLUDE matches
# (a regular expression on the path from the current folder). PUBLIC and PRIVATE are what it links. Includes are written from the
# root of the repository. Compiled folder by folder (RotorubUnity).
function(rotorub_library name)
  cmake_parse_arguments(ARG "" "FOLDER;EXCLUDE" "PUBLIC;PRIVATE" ${ARGN})
  set(folder ".")
  if(ARG_FOLDER)
    set(folder "${ARG_FOLDER}")
  endif()
  file(
    GLOB_RECURSE sources CONFIGURE_DEPENDS
    RELATIVE "${CMAKE_CURRENT_SOURCE_DIR}"
    "${folder}/*.cc" "${folder}/*.h")
  list(FILTER sources EXCLUDE REGEX "(^|/)main\\.cc$")
  if(ARG_EXCLUDE)
    list(FILTER sources EXCLUDE REGEX "${ARG_EXCLUDE}")
  endif()
  add_library(${name} STATIC ${sources})
  target_include_directories(${name} PUBLIC "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>"
                                            "$<INSTALL_INTERFACE:include;include/rotorub;include/rotorub/internal>")
  target_compile_features(${name} PUBLIC cxx_std_20)
  target_link_libraries(
    ${name}
    PUBLIC ${ARG_PUBLIC}
    PRIVATE ${ARG_PRIVATE} "$<BUILD_INTERFACE:rotorub_warnings>")
  rotorub_unity(${name})
endfunction()
