// The version of MuJoCo that a document is written for.
#pragma once

#include <compare>
#include <string>
#include <string_view>

namespace rotorub {

struct MujocoVersion {  // of a release, at least 2.2
  int major = 2, minor = 2, patch = 2;
  auto operator<=>(const MujocoVersion&) const = default;
};

// The version that this program is built with.
MujocoVersion built_for();

// Reads "3.12" or "3.12.0", at least 2.2. Throws std::invalid_argument.
MujocoVersion read_mujoco_version(std::string_view text);

std::string to_string(const MujocoVersion& version);  // "3.12.0"

}  // namespace rotorub
