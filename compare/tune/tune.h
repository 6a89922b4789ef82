// Finds the fastest setting of MuJoCo that can be trusted for a scene. It searches over the
// settings, judges each against the native model, and reports the remaining error of the one found.
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

// The result of a run in one setting: the metrics of the whole run, with its cost, or a failure.
struct Outcome {
  Metrics metrics;
  std::string failure;
};
// window_step: s; 20 of them are the window of the largest impulse (ImpulseWindow). A setting is
// judged with its own step, as `compare` does for a scene with this setting; runs at several steps
// for convergence share one window.
using Runner = std::function<Outcome(const Setting&, double window_step)>;
using Judge = std::function<std::vector<JudgedFigure>(const Metrics&, double step)>;

struct SearchParameters {
  std::vector<double> steps;  // s, descending
  std::vector<Setting> variants;
  // A variant is skipped if its last cost per step would make it more expensive than the best one
  // by this factor. The cost per step is noisy and may differ from that of a larger step.
  double margin = 1.2;
  std::function<void(const Setting&)> before;  // called before each run; may be empty
  const std::atomic<bool>* interrupt = nullptr;
};

// Runs every variant at decreasing steps until no smaller step can be cheaper than the best trusted
// setting. Returns all settings in the order of their runs. A setting that passes is also run at
// half of its step (JudgedSetting::luck).
std::vector<JudgedSetting> search(const SearchParameters& parameters, const Runner& run,
                                  const Judge& judge, double tolerance);

// The error of a trusted setting and its parts by cause, relative to the native value (points: the
// value itself), for each judged figure; a part is empty if it cannot be determined.
struct ErrorParts {
  std::vector<std::pair<const Figure*, SplitShares>> figures;
  std::string reason;  // why there are none; otherwise empty
};

struct TuneParameters {
  double tolerance = 0.01;    // share, for the judged figures
  std::vector<double> steps;  // s, descending
  int twins = 20;             // >= 0, of the native run at each step
  // For the settings that the choice depends on. Few repeats, because errors decide, and times only
  // between neighbours.
  bench::TimingParameters timing{5, 3, 5.0};
  std::function<void(double share, const std::string& what)> progress;  // may be empty
  const std::atomic<bool>* interrupt = nullptr;
};

struct TuneResult {
  scene::Scene scene;
  double tolerance = 0.0;
  int modes = 0;  // bending modes per plane
  std::vector<JudgedSetting> settings;
  Choice choice;
  ErrorParts errors;  // of the trusted setting
  // The native model's error from the modes left out, independent of the setting.
  ModelError model_error;
  bool interrupted = false;
};

// reader: reads the scene, which must have a contact, with further overrides after the user's.
// Throws what the reader throws, and std::runtime_error if the native model cannot run the scene.
TuneResult tune_scene(const bench::SceneReader& reader, const TuneParameters& parameters);

}  // namespace rotorub::tune
