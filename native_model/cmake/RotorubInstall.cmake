# install() and the CMake package `rotorub`:
#   find_package(rotorub)  ->  rotorub::native_model, rotorub::mjcf, rotorub::plugin (the MuJoCo C++ API)
# RotorubHeaders lists the headers.

include(CMakePackageConfigHelpers)

set(ROTORUB_PACKAGE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/rotorub")

foreach(part native_model mjcf plugin)
  set_target_properties(rotorub_${part} PROPERTIES EXPORT_NAME ${part})
  add_library(rotorub::${part} ALIAS rotorub_${part})
  install(TARGETS rotorub_${part} EXPORT rotorubTargets ARCHIVE DESTINATION
                                                                "${CMAKE_INSTALL_LIBDIR}")
endforeach()
include(RotorubHeaders)
install(
  EXPORT rotorubTargets
  NAMESPACE rotorub::
  DESTINATION "${ROTORUB_PACKAGE_DIR}")

configure_package_config_file(
  "${CMAKE_CURRENT_LIST_DIR}/rotorubConfig.cmake.in" "${PROJECT_BINARY_DIR}/rotorubConfig.cmake"
  INSTALL_DESTINATION "${ROTORUB_PACKAGE_DIR}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/rotorubConfigVersion.cmake"
                                 COMPATIBILITY SameMajorVersion)
install(
  FILES "${PROJECT_BINARY_DIR}/rotorubConfig.cmake"
        "${PROJECT_BINARY_DIR}/rotorubConfigVersion.cmake"
        "${CMAKE_CURRENT_LIST_DIR}/RotorubMujoco.cmake"
  DESTINATION "${ROTORUB_PACKAGE_DIR}")

# The program, the library to preload, the scenes.
install(TARGETS rotorub rotorub_mujoco RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}"
                                       LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(
  DIRECTORY "${PROJECT_SOURCE_DIR}/mjcf/"
  DESTINATION "${CMAKE_INSTALL_DATADIR}/rotorub/mjcf"
  FILES_MATCHING
  PATTERN "*.toml"
  PATTERN "*.xml")

# Manual page, completion, schema for editors, and documents.
set(ROTORUB_MANUAL_DIR "${PROJECT_BINARY_DIR}/manual")
install(FILES "${ROTORUB_MANUAL_DIR}/rotorub.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
install(
  FILES "${ROTORUB_MANUAL_DIR}/rotorub.bash"
  DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions"
  RENAME rotorub)
install(FILES "${ROTORUB_MANUAL_DIR}/scene.schema.json" DESTINATION "${CMAKE_INSTALL_DATADIR}/rotorub")
# The documents, in the folders that their links name, and their pictures except films.
file(
  GLOB_RECURSE documents
  RELATIVE "${PROJECT_SOURCE_DIR}"
  CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/compare/*.md" "${PROJECT_SOURCE_DIR}/mjcf/*.md" "${PROJECT_SOURCE_DIR}/native_model/*.md"
  "${PROJECT_SOURCE_DIR}/plugin/*.md" "${PROJECT_SOURCE_DIR}/renders/*.md" "${PROJECT_SOURCE_DIR}/compare/report/docs/*.png"
  "${PROJECT_SOURCE_DIR}/renders/samples/*.png" "${PROJECT_SOURCE_DIR}/mjcf/docs/*.jpg")
foreach(document README.md ${documents})
  get_filename_component(folder "${document}" DIRECTORY)
  install(FILES "${PROJECT_SOURCE_DIR}/${document}" DESTINATION "${CMAKE_INSTALL_DOCDIR}/${folder}")
endforeach()
install(
  FILES "${PROJECT_SOURCE_DIR}/LICENSE"
  DESTINATION "${CMAKE_INSTALL_DOCDIR}"
  RENAME copyright)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/native_model/examples/find_package" DESTINATION "${CMAKE_INSTALL_DOCDIR}/examples")
install(FILES "${PROJECT_SOURCE_DIR}/compare/matlab/rotorub_read.m" DESTINATION "${CMAKE_INSTALL_DATADIR}/rotorub/matlab")
