# rotorub_declare_room(<room> [USES <room>...])
#
# A room is a folder of a part (native_model, plugin, compare), or with the name "." the files that stand in the part's
# own folder. USES names the rooms of the part that its files include: all of them, no other, and each declared before it,
# so that no circle is possible. Configuring stops where that is not so; tests/package/rooms_test.py runs the same check
# on the sources as they are.
function(rotorub_declare_room room)
  cmake_parse_arguments(ARG "" "" "USES" ${ARGN})
  cmake_path(GET CMAKE_CURRENT_SOURCE_DIR FILENAME part)
  get_property(below GLOBAL PROPERTY ROTORUB_ROOMS_${part})
  foreach(other IN LISTS ARG_USES)
    if(NOT other IN_LIST below)
      message(FATAL_ERROR "${part}/CMakeLists.txt: the room ${room} uses ${other}, which is not declared before it. "
                          "Declare ${other} first; where ${other} uses ${room} as well, the two are a circle.")
    endif()
  endforeach()
  set_property(GLOBAL APPEND PROPERTY ROTORUB_ROOMS_${part} ${room})

  if(room STREQUAL ".")
    file(GLOB files RELATIVE "${CMAKE_CURRENT_SOURCE_DIR}" "*.h" "*.cc")
  else()
    file(GLOB_RECURSE files RELATIVE "${CMAKE_CURRENT_SOURCE_DIR}" "${room}/*.h" "${room}/*.cc")
  endif()
  set(included "")
  foreach(file IN LISTS files)
    file(STRINGS "${file}" lines REGEX "^#include \"${part}/")
    foreach(line IN LISTS lines)
      if(line MATCHES "^#include \"${part}/([^/\"]+)/")
        set(other ${CMAKE_MATCH_1})
      elseif(line MATCHES "^#include \"${part}/")
        set(other ".")
      else()
        continue() # what follows a semicolon
      endif()
      if(NOT other STREQUAL room AND NOT other IN_LIST ARG_USES)
        message(FATAL_ERROR "${part}/${file} includes the room ${other}, which the room ${room} does not declare. "
                            "Remove the include, or add ${other} to the USES of ${room} in ${part}/CMakeLists.txt.")
      endif()
      list(APPEND included ${other})
    endforeach()
  endforeach()
  foreach(other IN LISTS ARG_USES)
    if(NOT other IN_LIST included)
      message(FATAL_ERROR "${part}/CMakeLists.txt: the room ${room} declares that it uses ${other}, but no file of it "
                          "includes ${other}. Remove ${other} from its USES.")
    endif()
  endforeach()
endfunction()

# rotorub_rooms_are_all([EXCEPT <folder>...]): every folder of the part that holds sources is a room, but for these.
function(rotorub_rooms_are_all)
  cmake_parse_arguments(ARG "" "" "EXCEPT" ${ARGN})
  cmake_path(GET CMAKE_CURRENT_SOURCE_DIR FILENAME part)
  get_property(rooms GLOBAL PROPERTY ROTORUB_ROOMS_${part})
  file(GLOB_RECURSE files RELATIVE "${CMAKE_CURRENT_SOURCE_DIR}" "*/*.h" "*/*.cc")
  foreach(file IN LISTS files)
    string(REGEX MATCH "^[^/]+" folder "${file}")
    if(NOT folder IN_LIST rooms AND NOT folder IN_LIST ARG_EXCEPT)
      message(FATAL_ERROR "${part}/${file} is in no room. Declare the room ${folder} in ${part}/CMakeLists.txt.")
    endif()
  endforeach()
endfunction()
