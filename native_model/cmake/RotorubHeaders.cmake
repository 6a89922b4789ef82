# The public headers, which users' programs may include. Changes of them are announced in CHANGELOG.md. They are installed
# below include/rotorub with their paths: #include "native_model/scene/reader.h". Other headers that they include are
# installed below include/rotorub/internal and may change without notice; all others are not installed.
# tests/package/headers_test.py checks this.

set(ROTORUB_PUBLIC_HEADERS
    # A scene, and a native run of it.
    native_model/scene/reader.h
    native_model/scene/scene.h
    native_model/scene/run.h
    native_model/scene/rotor.h
    native_model/scene/drive.h
    native_model/scene/loads.h
    native_model/scene/mujoco.h
    native_model/scene/auxiliary_bearing.h
    native_model/scene/magnetic_bearing.h
    native_model/scene/diagnostic.h
    native_model/run/run_native.h
    native_model/trajectory/trajectory.h
    native_model/trajectory/keyphasor.h
    native_model/trajectory/full_passes.h
    native_model/contact/impact.h
    native_model/contact/contact_parameters.h
    native_model/contact/impact_record.h
    native_model/numerics/status.h
    # MuJoCo's model of a scene.
    mjcf/writer.h
    mjcf/mujoco_version.h
    # The plugin, linked into a program.
    plugin/hooks.h
    plugin/contact_force.h
    plugin/inverse.h
    plugin/differences.h
    plugin/linearise.h)
# The header of users' controllers in C and C++, <rotorub/controller.h>.
set(ROTORUB_CONTROLLER_HEADER native_model/control/abi/rotorub/controller.h)

# rotorub_included(<out> <header>...) sets `out` to the other headers that these include, directly or indirectly, as paths
# from the root of the repository.
function(rotorub_included out)
  set(seen ${ARGN})
  set(left ${ARGN})
  while(left)
    list(POP_FRONT left header)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${header}")
    file(STRINGS "${PROJECT_SOURCE_DIR}/${header}" lines REGEX "^#include \"")
    foreach(line IN LISTS lines)
      string(REGEX REPLACE "^#include \"([^\"]+)\".*" "\\1" included "${line}")
      if(NOT included IN_LIST seen)
        list(APPEND seen "${included}")
        list(APPEND left "${included}")
      endif()
    endforeach()
  endwhile()
  list(REMOVE_ITEM seen ${ARGN})
  set(${out} ${seen} PARENT_SCOPE)
endfunction()

# cmake --install build --component headers installs only the headers.
function(rotorub_install_headers folder)
  foreach(header IN LISTS ARGN)
    cmake_path(GET header PARENT_PATH path)
    install(FILES "${PROJECT_SOURCE_DIR}/${header}" DESTINATION "${folder}/${path}" COMPONENT headers)
  endforeach()
endfunction()
rotorub_included(ROTORUB_INTERNAL_HEADERS ${ROTORUB_PUBLIC_HEADERS})
rotorub_install_headers(include/rotorub ${ROTORUB_PUBLIC_HEADERS})
rotorub_install_headers(include/rotorub/internal ${ROTORUB_INTERNAL_HEADERS})
install(FILES "${PROJECT_SOURCE_DIR}/${ROTORUB_CONTROLLER_HEADER}" DESTINATION include/rotorub COMPONENT headers)

# cmake --build build --target docs builds their reference with Doxygen (Debian: doxygen). It is not part of `all`.
set(documented ${ROTORUB_PUBLIC_HEADERS} ${ROTORUB_CONTROLLER_HEADER})
list(TRANSFORM documented PREPEND "${PROJECT_SOURCE_DIR}/")
list(JOIN documented "\" \"" ROTORUB_DOCUMENTED)
configure_file("${CMAKE_CURRENT_LIST_DIR}/doxygen/Doxyfile.in" "${PROJECT_BINARY_DIR}/Doxyfile" @ONLY)
add_custom_target(
  docs
  COMMAND doxygen "${PROJECT_BINARY_DIR}/Doxyfile"
  COMMENT "Writing the reference of the public headers, ${PROJECT_BINARY_DIR}/docs/html/index.html (apt-get install doxygen)"
  VERBATIM)
