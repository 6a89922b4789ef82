# The binary that `rotorub fmu` packs into every FMU: the native model with the functions of FMI 2.0 and 3.0, which are
# its only exported symbols. It contains the C++ library, so that importers with another C++ library can load it, and it
# is stripped.
file(GLOB sources CONFIGURE_DEPENDS "fmu/binary/*.cc")
add_library(rotorub_fmu MODULE ${sources})
target_link_libraries(rotorub_fmu PRIVATE rotorub_native_model rotorub_warnings)
rotorub_optimise(rotorub_fmu)
set(shown "${CMAKE_CURRENT_SOURCE_DIR}/fmu/binary/exports.map")
target_link_options(rotorub_fmu PRIVATE "LINKER:--version-script,${shown}")
if(NOT ROTORUB_SANITIZE)
  target_link_options(rotorub_fmu PRIVATE -static-libstdc++ -static-libgcc "LINKER:--gc-sections,--strip-all")
else()
  # Every test packs the binary, so it has no debug information but function names for stack traces.
  target_link_options(rotorub_fmu PRIVATE "LINKER:--strip-debug")
endif()
set_target_properties(rotorub_fmu PROPERTIES LINK_DEPENDS "${shown}")
add_dependencies(rotorub_compare_fmu rotorub_fmu)
install(TARGETS rotorub_fmu LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}")
# The platform's name in FMI 3.0 (section 2.5.1.4.1).
string(TOLOWER "${CMAKE_SYSTEM_PROCESSOR}-${CMAKE_SYSTEM_NAME}" platform)
set_source_files_properties(fmu/description.cc PROPERTIES COMPILE_DEFINITIONS ROTORUB_FMU_PLATFORM="${platform}")
