// Selects a setting from the judged ones, as a pure function.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/study/trust.h"
#include "compare/tune/setting.h"

namespace rotorub::tune {

// One setting compared with the native model.
struct JudgedSetting {
  Setting setting;
  std::vector<JudgedFigure> figures;  // the judged ones; empty without a run
  Trust trust = Trust::kNo;
  std::string failure;  // why the run did not end well; empty if it did
  // The check that fails at half of the step. A setting that passes at one step and fails at a
  // finer one passed by luck. Empty if nothing fails or if it was not tested.
  std::string luck;
  double us_per_step = 0.0;  // 0: unknown

  bool is_trusted() const { return trust == Trust::kYes && failure.empty() && luck.empty(); }
  // Wall time per second of simulated time, s; empty if unknown.
  std::optional<double> cost() const;
  // Keys of the figures that are outside; also "run" for a failure and "half_step" for luck.
  std::vector<std::string> wrong() const;
};

// Indices of settings.
struct Choice {
  std::optional<std::size_t> trusted;       // the cheapest trusted setting
  std::optional<std::size_t> next_cheaper;  // the most expensive setting that is cheaper than it
  // The best setting of each contact model, in the models' order: the cheapest trusted one,
  // otherwise the nearest one.
  std::vector<std::size_t> best_by_contact;
  // If no setting is trusted: the one with the fewest averages outside, and among those the
  // smallest largest deviation of an average; ties are decided in the same way by the figures of
  // single moments.
  std::optional<std::size_t> nearest;
};

Choice choose(const std::vector<JudgedSetting>& settings);

}  // namespace rotorub::tune
