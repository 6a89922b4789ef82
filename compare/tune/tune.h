// The fastest setting of MuJoCo that can be trusted for a scene: a search over its settings, each
// judged against the native model, and what the one found is still wrong by.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "compare/bench/engines.h"
#include "compare/bench/point.h"
#include "compare/metrics/metrics.h"
#include "compare/model_error/model_error.h"
#include "compare/tune/choice.h"
#include "native_model/scene/scene.h"

namespace rotorub::tune {

// Runs one setting: Metrics of a whole run with its cost in them, or a failure.
struct Outcome {
  Metrics metrics;
  std::string failure;
};
// window_step: s, 20 of which are the window of the largest impulse (ImpulseWindow). A setting
// is judged with its own step's, as `compare` judges the scene that has it; runs at several steps
// that are to converge share one.
using Runner = std::function<Outcome(const Setting&, double window_step)>;
using Judge = std::function<std::vector<JudgedFigure>(const Metrics&, double step)>;

struct SearchParameters {
  std::vector<double> steps;  // s, falling
  std::vector<Setting> variants;
  // A variant whose last cost of a step would make it dearer than the best by this factor is left
  // out: the cost of a step is noisy, and need not be that of a larger one.
  double margin = 1.2;
  std::function<void(const Setting&)> before;  // each run; may be empty
  const std::atomic<bool>* interrupt = nullptr;
};

// Every variant at ever smaller steps, until no smaller step can be cheaper than what is trusted
// already. All settings that were run, in the order in which they were; what passes is run at half
// of its step too (JudgedSetting::luck).
std::vector<JudgedSetting> search(const SearchParameters& parameters, const Runner& run,
                                  const Judge& judge, double tolerance);

// What a trusted setting is wrong by, and whose fault each part is: as shares of the native value
// (points: as they are), one for each judged figure; none where it cannot be determined.
struct ErrorParts {
  std::vector<std::pair<const Figure*, SplitShares>> figures;
  std::string reason;  // why there is nothing at all; empty: there is
};

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
