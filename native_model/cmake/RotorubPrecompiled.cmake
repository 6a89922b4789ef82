# What nearly every unit includes, compiled once: what is left of the reading of headers when the files of a folder
# are one unit (RotorubUnity), and half of a unit's time where each file is one.
#
# One for whoever compiles with the same flags (g++ takes none that was made with others) and needs the same third
# parties; it belongs to the first target of them, and the others reuse it:
#   rotorub_native_model   also mjcf, plugin
#   rotorub_renders        with fmt
#   rotorub_compare_base   with fmt and nlohmann_json; also the other rooms of compare
#   rotorub_test_support   with googletest; also the test programs and the benchmarks
# It is a matter of speed alone: every file includes what it uses, which the preset nan-init checks by building
# without any (CMAKE_DISABLE_PRECOMPILE_HEADERS). A unit with flags of its own, such as -mavx2, sets the property
# SKIP_PRECOMPILE_HEADERS.

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
