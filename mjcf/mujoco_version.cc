#include "mjcf/mujoco_version.h"

#include <charconv>
#include <stdexcept>

namespace rotorub {

MujocoVersion read_mujoco_version(std::string_view text) {
  MujocoVersion version{0, 0, 0};
  const char *at = text.data(), *const end = at + text.size();
  bool read = true;
  int parts = 0;
  for (int* part : {&version.major, &version.minor, &version.patch}) {
    const auto [next, error] = std::from_chars(at, end, *part);
    read = read && error == std::errc{} && *part >= 0;
    at = next;
    ++parts;
    if (!read || at == end || *at != '.') break;
    ++at;
  }
  if (!read || at != end || parts < 2 || version < MujocoVersion{2, 2, 0}) {
    throw std::invalid_argument("MuJoCo version \"" + std::string(text) +
                                "\" is not a version from 2.2 on; write it as 3.12 or 3.12.0");
  }
  return version;
}

MujocoVersion built_for() {
  static const MujocoVersion version = read_mujoco_version(ROTORUB_MUJOCO_VERSION);
  return version;
}

std::string to_string(const MujocoVersion& version) {
  return std::to_string(version.major) + "." + std::to_string(version.minor) + "." +
         std::to_string(version.patch);
}

}  // namespace rotorub
