# The peers of `rotorub bench` whose solver is a library, each a module that the program loads when it is asked
# for (compare/peers/module.h). A library that is not here costs that peer alone.

# rotorub_peer(<name> <package> <library or include folder>...): compare/peers/<name>.cc, if all of these were found.
function(rotorub_peer name package)
  foreach(part IN LISTS ARGN)
    if(NOT part)
      message(STATUS "bench: ${name} is left out: ${package} is not installed")
      return()
    endif()
  endforeach()
  set(folders ${ARGN})
  list(FILTER folders EXCLUDE REGEX "\\.(so|a)$")
  set(libraries ${ARGN})
  list(FILTER libraries INCLUDE REGEX "\\.(so|a)$")
  add_library(rotorub_peer_${name} MODULE peers/${name}.cc)
  target_include_directories(rotorub_peer_${name} PRIVATE "${PROJECT_SOURCE_DIR}")
  target_include_directories(rotorub_peer_${name} SYSTEM PRIVATE ${folders})
  target_link_libraries(rotorub_peer_${name} PRIVATE ${libraries} rotorub_warnings)
  set_target_properties(rotorub_peer_${name} PROPERTIES CXX_STANDARD 20 CXX_STANDARD_REQUIRED ON)
  add_dependencies(rotorub_compare_peers rotorub_peer_${name})
  # A component of its own, which the Debian package leaves out: Siconos alone brings forty libraries.
  install(TARGETS rotorub_peer_${name} LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT peers)
endfunction()

find_path(ROTORUB_ODE_INCLUDE ode/ode.h)
find_library(ROTORUB_ODE ode)
rotorub_peer(ode libode-dev "${ROTORUB_ODE_INCLUDE}" "${ROTORUB_ODE}")

# Its own siconos-config.cmake asks for programs of a package that the libraries do not need.
find_path(ROTORUB_SICONOS_INCLUDE SiconosConfig.h PATH_SUFFIXES siconos)
find_path(ROTORUB_SICONOS_KERNEL_INCLUDE SiconosKernel.hpp PATH_SUFFIXES siconos/kernel)
find_path(ROTORUB_SICONOS_NUMERICS_INCLUDE SolverOptions.h PATH_SUFFIXES siconos/numerics)
find_library(ROTORUB_SICONOS_KERNEL siconos_kernel)
find_library(ROTORUB_SICONOS_NUMERICS siconos_numerics)
rotorub_peer(
  siconos
  libsiconos-kernel-dev
  "${ROTORUB_SICONOS_INCLUDE}"
  "${ROTORUB_SICONOS_KERNEL_INCLUDE}"
  "${ROTORUB_SICONOS_NUMERICS_INCLUDE}"
  "${ROTORUB_SICONOS_KERNEL}"
  "${ROTORUB_SICONOS_NUMERICS}")
if(TARGET rotorub_peer_siconos)
  # With the Boost of Debian 12 its headers use std::allocator::construct, which C++20 has no more.
  set_target_properties(rotorub_peer_siconos PROPERTIES CXX_STANDARD 17 CXX_STANDARD_REQUIRED ON)
endif()
