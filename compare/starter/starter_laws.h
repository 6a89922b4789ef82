// The controller that `rotorub init --form controller` writes beside its scene, in C, C++ and
// Python.
#pragma once

#include <array>
#include <string_view>

namespace rotorub {

struct StarterFile {
  std::string_view name;  // within a folder of their own
  std::string_view text;
};

// One law three times; the header that it needs, and what calls the one in Python.
std::array<StarterFile, 5> starter_laws();

}  // namespace rotorub
