#include "compare/starter/starter_laws.h"

namespace rotorub {

// Embedded files (compare/CMakeLists.txt).
std::string_view follow_c();
std::string_view follow_cc();
std::string_view follow_law_py();
std::string_view controller_h();

std::vector<StarterFile> starter_laws(std::string_view scene) {
  constexpr std::string_view kScene = "SCENE.toml";
  std::vector<StarterFile> files{{"follow.c", std::string(follow_c())},
                                 {"follow.cc", std::string(follow_cc())},
                                 {"follow_law.py", std::string(follow_law_py())},
                                 {"rotorub/controller.h", std::string(controller_h())}};
  for (StarterFile& file : files) {
    const std::size_t at = file.text.find(kScene);
    if (at != std::string::npos) file.text.replace(at, kScene.size(), scene);
  }
  return files;
}

}  // namespace rotorub
