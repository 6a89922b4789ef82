# Several files of a folder as one unit: most of a unit's time goes into the same headers and the same templates
# (Eigen, nlohmann_json, googletest) again. The sixteen files of compare/sweep: 17 s together, 56 s one by one.
#
# A folder is one unit, or several of equal size. Its files therefore share their anonymous namespaces: a second
# file that needs a helper takes it from a header, and names that differ in meaning differ in the folder. A file
# with options or definitions of its own stays alone (CMake sees to that). The preset nan-init builds file by file,
# which checks that each includes what it uses; -DROTORUB_UNITY=OFF does anywhere, for who edits one file much.

option(ROTORUB_UNITY "Compile the files of a folder together" ON)
set(ROTORUB_UNITY_MOST 16) # files a unit

# rotorub_unity(<target>): the .cc files that the target has by now.
function(rotorub_unity target)
  if(NOT ROTORUB_UNITY)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cc$")

  # files_<folder>, the folder as an identifier
  set(folders "")
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source OUTPUT_VARIABLE folder)
    cmake_path(GET folder PARENT_PATH folder)
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY "${PROJECT_SOURCE_DIR}")
    string(MAKE_C_IDENTIFIER "${folder}" folder)
    list(APPEND folders ${folder})
    list(APPEND files_${folder} "${source}")
  endforeach()
  list(REMOVE_DUPLICATES folders)

  foreach(folder IN LISTS folders)
    list(LENGTH files_${folder} count)
    math(EXPR units "(${count} + ${ROTORUB_UNITY_MOST} - 1) / ${ROTORUB_UNITY_MOST}")
    set(index 0)
    foreach(file IN LISTS files_${folder})
      math(EXPR unit "${index} * ${units} / ${count}")
      set_source_files_properties("${file}" PROPERTIES UNITY_GROUP ${folder}_${unit})
      math(EXPR index "${index} + 1")
    endforeach()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
