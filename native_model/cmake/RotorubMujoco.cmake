# Finds MuJoCo: Debian's package, or, with MUJOCO_DIR, any release from 2.2.2 to today's (an unpacked release,
# or the folder of Python's package `mujoco`). The file is also installed with the CMake package `rotorub`.

set(MUJOCO_DIR
    ""
    CACHE PATH "Folder with include/mujoco and libmujoco.so.<version> (in lib or beside); empty: the system's")

# rotorub_import_mujoco(<target> <folder>) makes the MuJoCo of that folder an imported target. It uses the library with a
# version in its name, because Python's package has no link without one.
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

# rotorub_mujoco_version(<target> <variable>) reads the version, such as "2.2.2", from the headers.
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
  # Debian's package names the include folder of libqhull, on which it does not depend; the folder is removed.
  get_target_property(_rotorub_mujoco_include mujoco::mujoco INTERFACE_INCLUDE_DIRECTORIES)
  list(FILTER _rotorub_mujoco_include EXCLUDE REGEX "libqhull")
  set_target_properties(mujoco::mujoco PROPERTIES INTERFACE_INCLUDE_DIRECTORIES
                                                  "${_rotorub_mujoco_include}")
  unset(_rotorub_mujoco_include)
endif()
rotorub_mujoco_version(mujoco::mujoco ROTORUB_MUJOCO_VERSION)
