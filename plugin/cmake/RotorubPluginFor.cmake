# Builds the plugin for another MuJoCo than the rest of the build. Only mjcf and plugin, which include mujoco.h, are
# compiled again; they are linked with the native model of this build.

# rotorub_plugin_library(<name> <folder> [EXCLUDE <regex>] [LINK <target>...]): the static library of a folder.
function(rotorub_plugin_library name folder)
  cmake_parse_arguments(ARG "" "EXCLUDE" "LINK" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${folder}/*.cc")
  if(ARG_EXCLUDE)
    list(FILTER sources EXCLUDE REGEX "${ARG_EXCLUDE}")
  endif()
  add_library(${name} STATIC ${sources})
  target_include_directories(${name} PUBLIC "${PROJECT_SOURCE_DIR}")
  target_link_libraries(${name} PUBLIC rotorub_native_model ${ARG_LINK} PRIVATE rotorub_warnings)
  rotorub_optimise(${name}) # as the precompiled header is
  target_precompile_headers(${name} REUSE_FROM rotorub_native_model)
  rotorub_unity(${name})
endfunction()

# rotorub_plugin_for(<suffix> <folder>): the targets mujoco_<suffix>, rotorub_mjcf_<suffix>, rotorub_plugin_<suffix> and
# rotorub_mujoco_<suffix>, lib/<suffix>/librotorub_mujoco.so, for the MuJoCo of that folder (as MUJOCO_DIR). Call it at most once
# in a folder of this build. Sets <suffix>_version to that MuJoCo's version.
function(rotorub_plugin_for suffix folder)
  rotorub_import_mujoco(mujoco_${suffix} "${folder}")
  rotorub_mujoco_version(mujoco_${suffix} version)
  set(${suffix}_version
      "${version}"
      PARENT_SCOPE)
  rotorub_plugin_library(rotorub_mjcf_${suffix} mjcf)
  target_include_directories(rotorub_mjcf_${suffix} SYSTEM
                             PRIVATE $<TARGET_PROPERTY:fmt::fmt,INTERFACE_INCLUDE_DIRECTORIES>)
  set_source_files_properties("${PROJECT_SOURCE_DIR}/mjcf/mujoco_version.cc"
                              PROPERTIES COMPILE_DEFINITIONS ROTORUB_MUJOCO_VERSION="${version}")
  rotorub_plugin_library(rotorub_plugin_${suffix} plugin EXCLUDE "/(register|examples/.*)\\.cc$" LINK
                         rotorub_mjcf_${suffix} mujoco_${suffix})
  add_library(rotorub_mujoco_${suffix} SHARED "${PROJECT_SOURCE_DIR}/plugin/register.cc")
  target_link_libraries(rotorub_mujoco_${suffix} PRIVATE rotorub_plugin_${suffix} rotorub_warnings)
  set_target_properties(
    rotorub_mujoco_${suffix}
    PROPERTIES OUTPUT_NAME rotorub_mujoco
               LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib/${suffix}"
               CXX_VISIBILITY_PRESET hidden
               VISIBILITY_INLINES_HIDDEN ON)
  target_link_options(rotorub_mujoco_${suffix} PRIVATE -Wl,--exclude-libs,ALL -Wl,--as-needed -Wl,--no-undefined)
  rotorub_debug_beside(rotorub_mujoco_${suffix})
endfunction()
