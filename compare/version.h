#pragma once

#include <string>

namespace rotorub {

std::string program_version();  // "0.1.0"
std::string mujoco_version();   // of the library in use, "2.2.2"

// "rotorub 0.1.0 (MuJoCo 2.2.2)"; where the library is not the one that it was built for, both.
std::string version_line();

}  // namespace rotorub
