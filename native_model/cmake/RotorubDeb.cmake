# The Debian package: `cmake --build build --target deb` makes build/package/*.deb.
# (The target `package` also makes it, but builds all tests first.) This file is included after every install().

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME rotorub)
set(CPACK_PACKAGE_CONTACT "The authors of rotorub <rotorub@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
    "Says whether the contact forces of a rub in MuJoCo are physics or the solver. Holds the program, the plugin to preload \
into MuJoCo's programs, the scenes, and libraries, headers and CMake package for programs and controllers of one's own.")
# One package contains everything but the peers of `rotorub bench`.
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL Unspecified headers)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
# dpkg-shlibdeps (dpkg-dev, file) finds the libraries that the program and the plugin are linked with.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS libosmesa6)  # what it loads itself (renders/stage.cc)
# ffmpeg encodes films; laws in Python need its interpreter; find_package(rotorub) needs Eigen and MuJoCo.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "ffmpeg, python3, libeigen3-dev, libmujoco-dev, libgl-dev")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "cmake, bash-completion, libmujoco-samples")
set(CPACK_OUTPUT_FILE_PREFIX "${PROJECT_BINARY_DIR}/package")
include(CPack)

set(parts rotorub rotorub_mujoco rotorub_fmu rotorub_manual rotorub_native_model rotorub_mjcf rotorub_plugin)
if(TARGET rotorub_native)
  list(APPEND parts rotorub_native)
endif()
# The native model with which a page reruns its scene.
if(ROTORUB_EMCMAKE)
  list(APPEND parts rotorub_live)
else()
  message(STATUS "pages of the Debian package have no sliders: emscripten is not installed")
endif()
add_custom_target(
  deb
  COMMAND "${CMAKE_CPACK_COMMAND}" -G DEB
  DEPENDS ${parts}
  WORKING_DIRECTORY "${PROJECT_BINARY_DIR}"
  COMMENT "Packing ${PROJECT_BINARY_DIR}/package/*.deb"
  VERBATIM)
