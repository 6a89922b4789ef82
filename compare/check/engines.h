// The engines that `rotorub check` runs every scene on.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "compare/engine/engine.h"
#include "native_model/scene/rules.h"

namespace rotorub::check {

struct CheckEngine {
  std::string name;    // "native-event"
  std::string column;  // of the table: "event"
  scene::RuleEngine word = scene::RuleEngine::kNative;
  bool native = false;      // decides the exit code
  bool exact_rows = false;  // rows obey the laws to round-off: `event`
  std::shared_ptr<const Engine> engine;
};

// native-event, native-midpoint, native-verlet, and MuJoCo with each contact model. (`euler`
// is a baseline that is there to be wrong by its step, and is not checked.)
const std::vector<CheckEngine>& check_engines();

// The rules for this engine. Of MuJoCo, where the scene has none for it: those for every native
// one, so that its results are measured by what they should be.
std::vector<scene::Rule> rules_for(const CheckEngine& engine,
                                   const std::vector<scene::Rule>& rules);

}  // namespace rotorub::check
