# The settings of the compiler for all targets: language, output folders, floating point, sanitizers, warnings.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# native_model is linked into the preloaded plugin too.
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib")
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib")

# g++ collects garbage as soon as it uses 128 MB, which takes a tenth of the time of units with Eigen. With this option it
# begins at 1 GB. The largest unit needs 2.6 GB with it, and 2.5 GB without.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:--param=ggc-min-heapsize=1000000>")
endif()

# Installed programs find the MuJoCo of MUJOCO_DIR at the path that the build used.
set(CMAKE_INSTALL_RPATH_USE_LINK_PATH ON)

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # ccache caches units with a precompiled header only with this setting, and considers that header only with
  # -fpch-preprocess.
  set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros "${CCACHE_PROGRAM}")
  add_compile_options(-fpch-preprocess)
endif()

# The code does not depend on the processor: no contraction to FMA, no -ffast-math, no -march=native. Only the last bit of
# the C library's sin, pow, ... does (tests/package/frozen allows for it). Without errno the square roots of several
# numbers are one instruction.
add_compile_options(-ffp-contract=off -fno-math-errno)
# By default Eigen splits products of matrices by the sizes of the processor's caches, so that sums have another order on
# another processor. This definition makes it use fixed sizes (tests/native_model/numerics/cache_sizes_test.cc).
add_compile_definitions(EIGEN_NO_CPUID)

# Some functions also have a version for a larger instruction set. With sanitizers only the basic version is compiled,
# because every function contains calls of the sanitizer.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND NOT ROTORUB_SANITIZE)
  set(ROTORUB_EACH_TARGET ON)
  add_compile_definitions(ROTORUB_EACH_TARGET)
endif()

if(CMAKE_BUILD_TYPE STREQUAL "Debug")
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
endif()
if(ROTORUB_NAN_INIT)
  add_compile_definitions(EIGEN_INITIALIZE_MATRICES_BY_NAN)
endif()

# Protection of a program that reads foreign files: addresses of functions are resolved and made read-only before main, and
# overwritten stacks and too long copies are detected (tests/package/hardened_test.py).
if(NOT ROTORUB_SANITIZE)
  add_link_options(-Wl,-z,relro -Wl,-z,now)
  add_compile_options(-fstack-protector-strong)
  add_compile_definitions(_FORTIFY_SOURCE=2)
endif()

# A program that preloads an instrumented library must have the sanitizer's run-time library before it.
set(ROTORUB_SANITIZER_RUNTIME "")
if(ROTORUB_SANITIZE)
  add_compile_options(-fsanitize=${ROTORUB_SANITIZE} -fno-sanitize-recover=all
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${ROTORUB_SANITIZE})
  if(ROTORUB_SANITIZE MATCHES "address")
    # Matrices are allocated as in a release, because its code may free them (ROTORUB_RELEASE_ARCHIVE). The sanitizer's
    # malloc aligns to 16 bytes too.
    add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)
    # These checks would take a quarter of a unit's time. The address sanitizer finds null and dangling objects too, and
    # Eigen's assertion finds misaligned matrices.
    add_compile_options(-fno-sanitize=null,alignment,object-size,vptr)
    execute_process(
      COMMAND ${CMAKE_CXX_COMPILER} -print-file-name=libasan.so
      OUTPUT_VARIABLE ROTORUB_SANITIZER_RUNTIME
      OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  endif()
endif()

# rotorub_optimise(<target>): a release compiles the target with -O3. Only the integrators run long, natively and in
# MuJoCo; everything else is compiled with -O1, in half the time. Without semantic interposition a function may be inlined
# into others of its unit, although the code is position independent.
function(rotorub_optimise target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O3;-fno-semantic-interposition>)
endfunction()

# rotorub_link_optimised_first(<program> <library>...): the linker keeps the first copy that it meets of an inline function
# or a template; these libraries come before everything else, so that a program has their copies, compiled with -O3.
function(rotorub_link_optimised_first program)
  if(ROTORUB_SANITIZE)
    return()
  endif()
  foreach(library IN LISTS ARGN)
    target_link_options(${program} PRIVATE "LINKER:--whole-archive,$<TARGET_FILE:${library}>,--no-whole-archive")
  endforeach()
endfunction()

# rotorub_debug_beside(<target>): a release moves the debug information of a program or library into the file
# <target file>.debug beside it, where debuggers look for it.
function(rotorub_debug_beside target)
  if(ROTORUB_SANITIZE OR CMAKE_BUILD_TYPE STREQUAL "Debug")
    return()
  endif()
  set(file "$<TARGET_FILE:${target}>")
  add_custom_command(
    TARGET ${target}
    POST_BUILD
    COMMAND "${CMAKE_OBJCOPY}" --only-keep-debug "${file}" "${file}.debug"
    COMMAND "${CMAKE_OBJCOPY}" --strip-debug "--add-gnu-debuglink=${file}.debug" "${file}"
    VERBATIM)
endfunction()

# Every target links this privately: warnings are errors.
add_library(rotorub_warnings INTERFACE)
target_compile_options(
  rotorub_warnings
  INTERFACE -Wall
            -Wextra
            -Wpedantic
            -Wshadow
            -Wconversion
            -Wdouble-promotion
            -Wnon-virtual-dtor
            -Woverloaded-virtual
            -Wold-style-cast
            -Wcast-qual
            -Wformat=2
            -Wduplicated-cond
            -Wlogical-op
            -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 reports a false overlap in every "text" + std::string (its bug 105651); with a precompiled header it is
  # a false overflow or overread in the same places.
  target_compile_options(rotorub_warnings INTERFACE -Wno-restrict)
  if(NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
    target_compile_options(rotorub_warnings INTERFACE -Wno-array-bounds -Wno-stringop-overflow
                                                      -Wno-stringop-overread)
  endif()
  if(ROTORUB_SANITIZE)
    # The sanitizers' checks hide initialisations from the optimiser.
    target_compile_options(rotorub_warnings INTERFACE -Wno-maybe-uninitialized)
  endif()
endif()
