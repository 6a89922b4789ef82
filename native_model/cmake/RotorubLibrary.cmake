# rotorub_library(<name> [FOLDER <folder>] [EXCLUDE <regex>] [PUBLIC <target>...] [PRIVATE <target>...])
#
# Makes the static library of the current folder, or of FOLDER in it, from every .cc below it except main.cc and the paths
# from the current folder that match EXCLUDE (a regular expression). It links PUBLIC and PRIVATE. Includes are relative to
# the root of the repository. The files of a folder are compiled together (RotorubUnity).
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
