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

// What the settings are taken from: steps of the fixed steps, tolerances of the others.
struct Ladder {
  std::vector<double> steps;       // s, > 0
  std::vector<double> tolerances;  // relative, > 0
};

// 1-2-5 from 200 us to 1 us; decades from 1e-4 to 1e-12.
Ladder default_ladder();

// "100us,20us, 1e-6": times separated by commas. Throws std::invalid_argument that says which entry
// is wrong and what is accepted.
std::vector<double> parse_steps(const std::string& list);
// "1e-6,1e-9": numbers in (0, 1).
std::vector<double> parse_tolerances(const std::string& list);

}  // namespace rotorub::bench
