# Finds MuJoCo. Debian's package names the include folder of a libqhull it does not depend on: leave it out.
# Also installed with the package `rotorub`, whose users meet the same folder.

find_package(mujoco 2.2 CONFIG QUIET)
if(NOT TARGET mujoco::mujoco)
  message(FATAL_ERROR "MuJoCo 2.2 or later was not found (Debian: libmujoco-dev)")
endif()
get_target_property(_rotorub_mujoco_include mujoco::mujoco INTERFACE_INCLUDE_DIRECTORIES)
list(FILTER _rotorub_mujoco_include EXCLUDE REGEX "libqhull")
set_target_properties(mujoco::mujoco PROPERTIES INTERFACE_INCLUDE_DIRECTORIES
                                                "${_rotorub_mujoco_include}")
unset(_rotorub_mujoco_include)
