// The controller that `rotorub init --form controller` writes beside its scene, in C, C++ and
// Python.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rotorub {

struct StarterFile {
  std::string_view name;  // within a folder of their own
  std::string text;
};

// One law three times, each with the lines that compile and run it from its folder; the header that
// it needs, and what calls the one in Python. scene: name of the file beside the folder.
std::vector<StarterFile> starter_laws(std::string_view scene);

}  // namespace rotorub
