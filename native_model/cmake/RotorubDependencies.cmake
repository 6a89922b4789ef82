# The external dependencies, by the folder that first needs them. compare/setup installs the Debian packages.

# The files that compare/setup fetches come first, because without it the others may be missing too.
foreach(file plotly-basic.min.js three.module.js esbuild)
  if(NOT EXISTS "${ROTORUB_WEB_DIR}/${file}")
    message(FATAL_ERROR "${ROTORUB_WEB_DIR}/${file} is missing: run compare/setup, which fetches it, "
                        "or set ROTORUB_WEB_DIR to a folder that has it")
  endif()
endforeach()

# native_model
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_path(ROTORUB_TOMLPLUSPLUS_INCLUDE toml++/toml.h REQUIRED)
find_path(ROTORUB_BOOST_INCLUDE boost/math/tools/toms748_solve.hpp REQUIRED)

# mjcf
find_package(fmt 9 REQUIRED)

# plugin
include(RotorubMujoco)

# renders
find_package(PkgConfig REQUIRED)
pkg_check_modules(OSMESA REQUIRED osmesa)
pkg_check_modules(FREETYPE REQUIRED IMPORTED_TARGET freetype2)
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo-ft)
find_path(ROTORUB_FONTS DejaVuSans.ttf PATHS /usr/share/fonts/truetype/dejavu NO_DEFAULT_PATH REQUIRED)

# compare
find_package(nlohmann_json 3.11 REQUIRED)
find_package(CLI11 2.1 REQUIRED)
find_package(SQLite3 3.40 REQUIRED)
pkg_check_modules(fftw3 REQUIRED IMPORTED_TARGET fftw3)
pkg_check_modules(nlopt REQUIRED IMPORTED_TARGET nlopt_cxx)
pkg_check_modules(libzip REQUIRED IMPORTED_TARGET libzip)

# tests
if(ROTORUB_BUILD_TESTS)
  find_package(GTest 1.12 REQUIRED)
  find_package(benchmark 1.7 REQUIRED)
endif()
