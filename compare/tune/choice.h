// From judged settings to the one to be taken: a pure function.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/study/trust.h"
#include "compare/tune/setting.h"

namespace rotorub::tune {

// One setting against the native model.
struct JudgedSetting {
  Setting setting;
  std::vector<JudgedFigure> figures;  // the judged ones; empty: no run
  Trust trust = Trust::kNo;
  std::string failure;  // why the run did not end well; empty: it did
  // What is wrong at half of its step: a setting that passes at one step and fails at a finer one
  // has passed by luck. Empty: nothing, or not looked at.
  std::string luck;
  double us_per_step = 0.0;  // 0: not known

  bool is_trusted() const { return trust == Trust::kYes && failure.empty() && luck.empty(); }
  // Wall time for a second of simulated time, s; none where it is not known.
  std::optional<double> cost() const;
  // Keys of the figures that are outside; "run" for a failure, "half_step" for luck.
  std::vector<std::string> wrong() const;
};

// Indices of the settings.
struct Choice {
  std::optional<std::size_t> trusted;       // the cheapest of those to be trusted
  std::optional<std::size_t> next_cheaper;  // the dearest of those below it
  // Of each contact model its best, in their order: the cheapest that is trusted, or the nearest.
  std::vector<std::size_t> best_by_contact;
  // Where none can be trusted: the one with the fewest wrong averages, of these the one whose worst
  // average is nearest; then the same of single moments.
  std::optional<std::size_t> nearest;
};

Choice choose(const std::vector<JudgedSetting>& settings);

}  // namespace rotorub::tune
