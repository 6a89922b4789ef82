// Modules: what the program loads when it is asked for, so that it neither needs their libraries
// nor pays for loading them.
#pragma once

#include <filesystem>
#include <string>

namespace rotorub {

// Beside the program, as it is built and as it is installed; empty: nowhere.
std::filesystem::path module_file(const std::string& name);

}  // namespace rotorub
