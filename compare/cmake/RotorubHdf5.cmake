# The module that the program loads for `--format hdf5` (compare/hdf5/module.h). Without libhdf5-dev it is not built, and
# that option is refused with the reason.
pkg_check_modules(ROTORUB_HDF5 QUIET IMPORTED_TARGET hdf5)
if(ROTORUB_HDF5_FOUND)
  add_library(rotorub_hdf5 MODULE hdf5/image.cc)
  target_include_directories(rotorub_hdf5 PRIVATE "${PROJECT_SOURCE_DIR}")
  target_link_libraries(rotorub_hdf5 PRIVATE PkgConfig::ROTORUB_HDF5 rotorub_warnings)
  add_dependencies(rotorub_compare_hdf5 rotorub_hdf5)
  install(TARGETS rotorub_hdf5 LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}")
else()
  message(STATUS "run.h5 is left out: libhdf5-dev is not installed")
endif()
