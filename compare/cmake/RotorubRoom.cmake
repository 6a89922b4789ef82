# rotorub_room(<room> [EXCLUDE <regex>] [USES <room>...] [LINK <target>...])
#
# The library rotorub_compare_<room> of the folder compare/<room>. USES: the rooms that its files include, all of them
# and no other (tests/package/rooms_test.py), each declared before it, so that there is no circle. LINK: targets from
# outside compare. The interface target rotorub_compare is all rooms.
#
# The precompiled header is the first room's.
add_library(rotorub_compare INTERFACE)

function(rotorub_room room)
  cmake_parse_arguments(ARG "" "EXCLUDE" "USES;LINK" ${ARGN})
  set(name rotorub_compare_${room})
  set(used "")
  foreach(other IN LISTS ARG_USES)
    if(NOT TARGET rotorub_compare_${other})
      message(FATAL_ERROR "compare/${room} uses compare/${other}, which is no room declared before it")
    endif()
    list(APPEND used rotorub_compare_${other})
  endforeach()
  rotorub_library(
    ${name}
    FOLDER ${room}
    EXCLUDE "${ARG_EXCLUDE}"
    PUBLIC rotorub_native_model nlohmann_json::nlohmann_json ${used} ${ARG_LINK}
    PRIVATE fmt::fmt)
  if(room STREQUAL "base")
    target_precompile_headers(${name} PRIVATE ${ROTORUB_PRECOMPILED} <filesystem> <fmt/format.h>
                               "${PROJECT_SOURCE_DIR}/compare/base/json_library.h")
  else()
    target_precompile_headers(${name} REUSE_FROM rotorub_compare_base)
  endif()
  target_link_libraries(rotorub_compare INTERFACE ${name})
endfunction()
