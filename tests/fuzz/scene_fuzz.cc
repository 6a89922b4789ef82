// A scene's text is a scene, or refused with what is wrong: never a crash, and never a message that
// a terminal obeys or that has no end.

#include <cstdint>

#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "tests/fuzz/said.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rotorub;
  try {
    scene::parse_scene({reinterpret_cast<const char*>(data), size}, "scene.toml");
  } catch (const scene::SceneError& error) {
    test::check_said(error.what());
  }
  return 0;
}
