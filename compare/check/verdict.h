// The outcome of a run under one rule, and the rules that hold for every run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/metrics/residuals.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub::check {

// kRefused: the run did not begin, or ended with a status that says why it cannot work
// (step_too_large, no_solution, ambiguous, out_of_range).
enum class Outcome { kPass, kRefused, kViolates };
const char* to_string(Outcome outcome);

struct Verdict {
  Outcome outcome = Outcome::kPass;
  std::string rule;             // "error.rotor_x <= 1e-09"
  std::optional<double> value;  // the limited value, SI
  std::optional<double> limit;  // the violated limit, or the nearest one
  std::string reason;           // for a refusal; for a violation, by how much
};

// Checks that `value` is within [min, max]; NaN violates every limit.
Verdict limited(const std::string& metric, double value, std::optional<double> min,
                std::optional<double> max);

// Excess over the limit, relative to the limit (to 1e-300 for a limit of 0). 0 if the rule is not
// violated; infinite for a violation without a finite value.
double excess(const Verdict& verdict);

// The rules for every run that reached its end, whatever the scene's rules: every value is finite,
// impacts push, brake and add no energy, friction stays in its cone, and the rotor stays in its
// ring. For `event`, whose rows are exact, also complementarity and the sliding force.
std::vector<Verdict> law_verdicts(const Trajectory& trajectory,
                                  const std::vector<ContactFacts>& contacts, bool exact_rows);

// Checks every value in the series and impacts; also for a run that ended early.
Verdict finite_verdict(const Trajectory& trajectory);

}  // namespace rotorub::check
