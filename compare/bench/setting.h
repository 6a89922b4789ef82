// What a point of the bench is: one engine with one setting on one scene.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compare/engine/engine.h"

namespace rotorub::bench {

// The scene with further overrides ("mujoco.integrator=rk4") on top of the user's: MuJoCo's plugin
// reads the scene's text, so that a variant has to be read anew.
using SceneReader = std::function<scene::Scene(const std::vector<std::string>& further)>;

struct Setting {
  std::string engine;          // "mujoco-coulomb"
  std::string setting;         // what beside the step tells it from others: "rk4", "tolerance 1e-8"
  std::optional<double> step;  // s; none: the engine chooses its steps
  std::shared_ptr<const Engine> runner;
  std::shared_ptr<const scene::Scene> scene;
  std::string refusal;  // why the scene cannot be had in this setting; empty: it can
};

}  // namespace rotorub::bench
