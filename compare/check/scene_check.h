// A scene on every engine.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "compare/check/case.h"

namespace rotorub::check {

// Its rules, each metric of a known name. Throws scene::SceneError with the rule's place.
std::vector<scene::Rule> rules_of(const scene::Scene& scene);

// `progress`: share done and the engine that is at work. Stops after the engine at work once
// `interrupt` is true, and gives the cases so far. Throws scene::SceneError for a metric on a
// column that the scene does not have.
std::vector<Case> check_scene(const scene::Scene& scene, const std::vector<scene::Rule>& rules,
                              const std::function<void(double, const std::string&)>& progress,
                              const std::atomic<bool>* interrupt);

// Of a scene that cannot even be read, for the reason of `refusal`: refused by every engine.
std::vector<Case> refused_cases(const scene::Scene& scene, const std::vector<scene::Rule>& rules,
                                const std::string& refusal);

// Every native case passes, or is refused as its file says.
bool holds(const std::vector<Case>& cases);

}  // namespace rotorub::check
