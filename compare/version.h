#pragma once

#include <string>

namespace rotorub {

std::string program_version();  // "0.1.0"
std::string mujoco_version();   // of the library in use, "2.2.2"

}  // namespace rotorub
