# Compiles several files of a folder as one unit, because most of a unit's time goes into the same headers and templates
# (Eigen, nlohmann_json, googletest). The sixteen files of compare/sweep take 17 s together and 56 s one by one.
#
# A folder is one unit, or several of equal size. Its files therefore share their unnamed namespaces: a name there must be
# unique in the folder, and a helper that two files need goes into a header. CMake compiles a file with its own options or
# definitions separately. The preset nan-init compiles each file separately, which checks that each includes what it uses;
# -DROTORUB_UNITY=OFF does the same in any build and helps when one file is edited often.

option(ROTORUB_UNITY "Compile the files of a folder together" ON)
set(ROTORUB_UNITY_MOST 16) # files a unit

# rotorub_unity(<target>) combines the .cc files that the target has so far.
function(rotorub_unity target)
  if(NOT ROTORUB_UNITY)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cc$")

  # The list is named files_<folder>, with the folder as an identifier.
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
