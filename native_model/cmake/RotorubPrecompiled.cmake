# Headers that nearly every unit includes, compiled once. This saves most of the time that headers still take if the files
# of a folder are one unit (RotorubUnity), and half of a unit's time if each file is one.
#
# Targets with the same flags (g++ accepts no others) and the same third-party headers share one precompiled header. It
# belongs to the first of them, and the others reuse it:
#   rotorub_native_model   also mjcf, plugin
#   rotorub_renders        with fmt
#   rotorub_compare_base   with fmt and nlohmann_json; also the other rooms of compare
#   rotorub_test_support   with googletest; also the test programs and the benchmarks
# Every file includes what it uses; the preset nan-init checks this by building without precompiled headers
# (CMAKE_DISABLE_PRECOMPILE_HEADERS). A unit with other flags, such as -mavx2, sets the property SKIP_PRECOMPILE_HEADERS.

set(ROTORUB_PRECOMPILED
    <Eigen/Cholesky>
    <Eigen/Core>
    <Eigen/Geometry>
    <algorithm>
    <array>
    <cmath>
    <cstdint>
    <functional>
    <limits>
    <memory>
    <numbers>
    <optional>
    <random>
    <span>
    <sstream>
    <stdexcept>
    <string>
    <string_view>
    <utility>
    <vector>)
