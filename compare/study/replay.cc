#include "compare/study/replay.h"

#include "native_model/system/model.h"

namespace rotorub {

bool has_commands(const scene::Scene& scene) {
  return scene.controller && make_model(scene).controller != nullptr;
}

StepWatch CommandTape::watch() {
  return [this](const WatchedStep& step) { add(step); };
}

}  // namespace rotorub
