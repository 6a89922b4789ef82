// Modules: parts that the program loads on demand, so that it neither depends on their libraries
// nor spends time on loading them.
#pragma once

#include <filesystem>
#include <string>

namespace rotorub {

// The module's path beside the program, in the build tree or installed; empty if it does not exist.
std::filesystem::path module_file(const std::string& name);

}  // namespace rotorub
