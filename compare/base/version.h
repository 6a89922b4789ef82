#pragma once

#include <string>

namespace rotorub {

std::string program_version();  // "0.1.0"
std::string mujoco_version();   // of the library in use, "2.2.2"

// "rotorub 0.2.0 (MuJoCo: headers 2.2.2, run time 2.2.2)": the versions at build time and at run
// time.
std::string version_line();

}  // namespace rotorub
