#include "compare/starter/starter_laws.h"

namespace rotorub {

// Embedded (compare/CMakeLists.txt).
std::string_view follow_c();
std::string_view follow_cc();
std::string_view follow_py();
std::string_view python_controller_c();
std::string_view controller_h();

std::array<StarterFile, 5> starter_laws() {
  return {{{"follow.c", follow_c()},
           {"follow.cc", follow_cc()},
           {"follow.py", follow_py()},
           {"python_controller.c", python_controller_c()},
           {"rotorub/controller.h", controller_h()}}};
}

}  // namespace rotorub
