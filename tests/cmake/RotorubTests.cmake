include(GoogleTest)

# The paths that tests need, as string literals.
set(ROTORUB_TEST_DEFINITIONS
    ROTORUB_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    ROTORUB_MJCF_DIR="${PROJECT_SOURCE_DIR}/mjcf"
    ROTORUB_TEST_DATA_DIR="${PROJECT_SOURCE_DIR}/tests/data"
    ROTORUB_VERSION="${PROJECT_VERSION}"
    ROTORUB_BINARY="${PROJECT_BINARY_DIR}/bin/rotorub"
    ROTORUB_LIBRARIES="${PROJECT_BINARY_DIR}/lib"
    ROTORUB_PLUGIN="${PROJECT_BINARY_DIR}/lib/librotorub_mujoco.so"
    # The library that LD_PRELOAD must name before ROTORUB_PLUGIN; empty without sanitizers.
    ROTORUB_SANITIZER_RUNTIME="${ROTORUB_SANITIZER_RUNTIME}")

# The code of a test runs only for seconds, so it is compiled without optimisation and debug information, which halves the
# time to compile and link. The product's code that it calls is compiled as usual.
set(ROTORUB_TEST_OPTIONS $<$<CONFIG:Release>:-O0;-g0;-U_FORTIFY_SOURCE>)
if(ROTORUB_SANITIZE)
  set(ROTORUB_TEST_OPTIONS -O0)
endif()

# rotorub_test_support(): fixtures, comparisons and tolerances that several areas share (tests/support).
function(rotorub_test_support)
  file(GLOB sources CONFIGURE_DEPENDS "support/*.cc" "support/oracles/*.cc")
  list(FILTER sources EXCLUDE REGEX "_test\\.cc$")
  add_library(rotorub_test_support STATIC ${sources})
  target_link_libraries(
    rotorub_test_support
    PUBLIC rotorub_native_model rotorub_mjcf rotorub_plugin GTest::gtest
    PRIVATE rotorub_warnings)
  target_compile_definitions(rotorub_test_support PRIVATE ${ROTORUB_TEST_DEFINITIONS})
  # The library is linked only into programs and compiled with their flags, so that they can use its precompiled header.
  set_target_properties(rotorub_test_support PROPERTIES POSITION_INDEPENDENT_CODE OFF)
  target_compile_options(rotorub_test_support PRIVATE -fPIE ${ROTORUB_TEST_OPTIONS})
  target_precompile_headers(rotorub_test_support PRIVATE ${ROTORUB_PRECOMPILED} <filesystem>
                            <gtest/gtest.h>)
endfunction()

# rotorub_tests(<area> [LINK <target>...] [ALONE <folder>...] [START <target>...]): the test programs of tests/<area>,
# linked with the targets of LINK. The programs of the folders of ALONE are linked only with the library
# rotorub_<area>_<folder>, so that a build with sanitizers builds no more. `ninja tests_<area>` builds them, and the
# targets that they start or preload (START).
function(rotorub_tests area)
  cmake_parse_arguments(ARG "" "" "LINK;ALONE;START" ${ARGN})
  file(
    GLOB_RECURSE sources CONFIGURE_DEPENDS
    RELATIVE "${CMAKE_CURRENT_SOURCE_DIR}"
    "${area}/*_test.cc")
  add_custom_target(tests_${area})

  set(folders "")
  foreach(source IN LISTS sources)
    cmake_path(GET source PARENT_PATH folder)
    list(APPEND folders "${folder}")
  endforeach()
  list(REMOVE_DUPLICATES folders)

  foreach(folder IN LISTS folders)
    set(units ${sources})
    list(FILTER units INCLUDE REGEX "^${folder}/[^/]+$")
    string(REPLACE "/" "_" name "test_${folder}")
    add_executable(${name} ${units})
    set(linked ${ARG_LINK})
    cmake_path(GET folder FILENAME last)
    if(last IN_LIST ARG_ALONE)
      set(linked rotorub_${area}_${last})
    endif()
    target_link_libraries(${name} PRIVATE ${linked} rotorub_test_support GTest::gtest_main rotorub_warnings)
    target_compile_definitions(${name} PRIVATE ${ROTORUB_TEST_DEFINITIONS})
    target_compile_options(${name} PRIVATE ${ROTORUB_TEST_OPTIONS})
    # Without the product's debug information a program has 7 MB instead of 47.
    target_link_options(${name} PRIVATE $<$<CONFIG:Release>:LINKER:--strip-debug>)
    rotorub_link_optimised_first(${name} rotorub_native_model)
    target_precompile_headers(${name} REUSE_FROM rotorub_test_support)
    rotorub_unity(${name})
    add_dependencies(tests_${area} ${name})
    rotorub_discover(${name} ${area})
  endforeach()

  if(ARG_START)
    add_dependencies(tests_${area} ${ARG_START})
  endif()
endfunction()

# Each test case is one ctest entry. It gets its labels when ctest reads the list, because gtest_discover_tests gives all
# tests of a program the same single label.
# PREFIX: before every name. NIGHTLY: a regular expression of further names that are nightly.
function(rotorub_discover name area)
  cmake_parse_arguments(ARG "" "PREFIX;NIGHTLY" "" ${ARGN})
  gtest_discover_tests(${name} TEST_PREFIX "${ARG_PREFIX}" NO_PRETTY_VALUES DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60)
  configure_file("${PROJECT_SOURCE_DIR}/tests/cmake/test_properties.cmake.in" ${name}_properties.cmake @ONLY)
  set_property(
    DIRECTORY
    APPEND
    PROPERTY TEST_INCLUDE_FILES "${CMAKE_CURRENT_BINARY_DIR}/${name}_properties.cmake")
endfunction()
