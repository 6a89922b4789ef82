// The fastest setting of MuJoCo that can be trusted for a scene.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "compare/model_error/model_error.h"
#include "compare/tune/choice.h"
#include "compare/tune/errors.h"

namespace rotorub::tune {

struct TuneParameters {
  double tolerance = 0.01;    // share: on the judged figures
  std::vector<double> steps;  // s, falling
  int twins = 20;             // >= 0, of the native run at each step
  // Of the settings that the choice depends on. Few: errors decide, times only between neighbours.
  bench::TimingParameters timing{5, 3, 5.0};
  std::function<void(double share, const std::string& what)> progress;  // may be empty
  const std::atomic<bool>* interrupt = nullptr;
};

struct TuneResult {
  scene::Scene scene;
  double tolerance = 0.0;
  int modes = 0;  // bending modes in each plane
  std::vector<JudgedSetting> settings;
  Choice choice;
  ErrorParts errors;       // of the trusted setting
  ModelError model_error;  // of the modes kept: the native model's, whatever the setting
  bool interrupted = false;
};

// `reader`: the scene, which has a contact, with overrides beyond those of the user. Throws what
// the reader throws, and std::runtime_error where the native model cannot run it.
TuneResult tune_scene(const bench::SceneReader& reader, const TuneParameters& parameters);

}  // namespace rotorub::tune
