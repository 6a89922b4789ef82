// The search: every variant at ever smaller steps, until no smaller step can be cheaper than what
// is trusted already.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "compare/bench/setting.h"
#include "compare/bench/timing_pass.h"
#include "compare/tune/choice.h"
#include "compare/tune/reference.h"

namespace rotorub::tune {

// Runs one setting: Metrics of a whole run with its cost in them, or a failure.
struct Outcome {
  Metrics metrics;
  std::string failure;
};
// window_step: s, 20 of which are the window of the largest impulse (recorder.h). A setting
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

// All settings that were run, in the order in which they were. What passes is run at half of its
// step too (JudgedSetting::luck).
std::vector<JudgedSetting> search(const SearchParameters& parameters, const Runner& run,
                                  const Judge& judge, double tolerance);

// The runner in MuJoCo, without output. `reader`: the scene with further overrides.
Runner mujoco_runner(const bench::SceneReader& reader, const std::atomic<bool>* interrupt);

// The judge by the references.
Judge judge_by(References& references, double tolerance);

// Measures again, in turns, those that the choice depends on: of a cost near that of the cheapest
// trusted setting.
void time_again(std::vector<JudgedSetting>& settings, const Runner& run,
                const bench::TimingParameters& parameters, const std::atomic<bool>* interrupt);

}  // namespace rotorub::tune
