# rotorub_room(<room> [EXCLUDE <regex>] [USES <room>...] [LINK <target>...])
#
# Makes the library rotorub_compare_<room> from the folder compare/<room>. USES: the rooms that its files include, which
# rotorub_declare_room checks. LINK: targets from outside compare. The interface target rotorub_compare links all rooms.
#
# All rooms use the precompiled header of the first.
include(RotorubRooms)
add_library(rotorub_compare INTERFACE)

function(rotorub_room room)
  cmake_parse_arguments(ARG "" "EXCLUDE" "USES;LINK" ${ARGN})
  rotorub_declare_room(${room} USES ${ARG_USES})
  set(name rotorub_compare_${room})
  list(TRANSFORM ARG_USES PREPEND rotorub_compare_ OUTPUT_VARIABLE used)
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
