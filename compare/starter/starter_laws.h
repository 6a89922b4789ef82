// The controller that `rotorub init --form controller` writes beside its scene, in C, C++ and
// Python.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rotorub {

struct StarterFile {
  std::string_view name;  // within their folder
  std::string text;
};

// The same law in three languages, each with the commands to build and run it from its folder, and
// the header that C and C++ need. scene: name of the file beside the folder.
std::vector<StarterFile> starter_laws(std::string_view scene);

}  // namespace rotorub
