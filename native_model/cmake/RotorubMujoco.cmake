# Finds MuJoCo: Debian's package, or, with MUJOCO_DIR, any release from 2.2.2 to today's (an unpacked release,
# or the folder of Python's package `mujoco`). Also installed with the package `rotorub`.

set(MUJOCO_DIR
    ""
    CACHE PATH "Folder with include/mujoco and libmujoco.so.<version> (in lib or beside); empty: the system's")

# rotorub_import_mujoco(<target> <folder>): the MuJoCo of that folder as an imported target. The library itself,
# not its link without a version: that of Python's package has none.
function(rotorub_import_mujoco target folder)
  file(GLOB libraries "${folder}/lib/libmujoco.so.*" "${folder}/libmujoco.so.*")
  list(LENGTH libraries found)
  if(NOT found EQUAL 1 OR NOT EXISTS "${folder}/include/mujoco/mujoco.h")
    message(FATAL_ERROR "MUJOCO_DIR=${folder}: accepted: a folder with include/mujoco/mujoco.h and one "
                        "libmujoco.so.<version>, in lib or beside")
  endif()
  add_library(${target} SHARED IMPORTED GLOBAL)
  set_target_properties(${target} PROPERTIES IMPORTED_LOCATION "${libraries}"
                                             INTERFACE_INCLUDE_DIRECTORIES "${folder}/include")
endfunction()

# rotorub_mujoco_version(<target> <variable>): "2.2.2", of its headers.
function(rotorub_mujoco_version target variable)
  get_target_property(folders ${target} INTERFACE_INCLUDE_DIRECTORIES)
  find_file(header mujoco/mujoco.h PATHS ${folders} NO_DEFAULT_PATH NO_CACHE REQUIRED)
  file(STRINGS "${header}" line REGEX "#define mjVERSION_HEADER")
  string(REGEX MATCH "[0-9]+$" number "${line}")
  if(number GREATER_EQUAL 1000000) # 3012000, before 3.5 337
    math(EXPR major "${number} / 1000000")
    math(EXPR minor "${number} / 1000 % 1000")
    math(EXPR patch "${number} % 1000")
  else()
    math(EXPR major "${number} / 100")
    math(EXPR minor "${number} / 10 % 10")
    math(EXPR patch "${number} % 10")
  endif()
  set(${variable}
      "${major}.${minor}.${patch}"
      PARENT_SCOPE)
endfunction()

if(MUJOCO_DIR)
  if(NOT TARGET mujoco::mujoco)
    rotorub_import_mujoco(mujoco::mujoco "${MUJOCO_DIR}")
  endif()
else()
  find_package(mujoco 2.2 CONFIG QUIET)
  if(NOT TARGET mujoco::mujoco)
    message(FATAL_ERROR "MuJoCo 2.2 or later was not found (Debian: libmujoco-dev with libgl-dev, which it asks for; or MUJOCO_DIR)")
  endif()
  # Debian's package names the include folder of a libqhull it does not depend on: leave it out.
  get_target_property(_rotorub_mujoco_include mujoco::mujoco INTERFACE_INCLUDE_DIRECTORIES)
  list(FILTER _rotorub_mujoco_include EXCLUDE REGEX "libqhull")
  set_target_properties(mujoco::mujoco PROPERTIES INTERFACE_INCLUDE_DIRECTORIES
                                                  "${_rotorub_mujoco_include}")
  unset(_rotorub_mujoco_include)
endif()
rotorub_mujoco_version(mujoco::mujoco ROTORUB_MUJOCO_VERSION)
