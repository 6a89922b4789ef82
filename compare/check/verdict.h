// What a run came to under one rule, and the rules that hold for every run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/metrics/residuals.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub::check {

// kRefused: not begun, or ended with a status that says why it cannot work (step_too_large,
// no_solution, ambiguous, out_of_range).
enum class Outcome { kPass, kRefused, kViolates };
const char* to_string(Outcome outcome);

struct Verdict {
  Outcome outcome = Outcome::kPass;
  std::string rule;             // "error.rotor_x <= 1e-09"
  std::optional<double> value;  // of what the rule limits, SI
  std::optional<double> limit;  // the one that was passed, or that is nearest
  std::string reason;           // of a refusal, a violation: by how much
};

// `value` within [min, max]; a value that is no number is within nothing.
Verdict limited(const std::string& metric, double value, std::optional<double> min,
                std::optional<double> max);

// How far beyond the limit, in sizes of the limit (of 1e-300 for a limit of 0); 0: within, or
// nothing that is measured. The worst of several violations has the largest.
double excess(const Verdict& verdict);

// The rules of every run that came to its end, whatever its scene says: everything finite, impacts
// that push, brake and give no energy, friction in its cone, the rotor in its ring. Of `event`,
// whose rows are exact, complementarity and the force of sliding too.
std::vector<Verdict> law_verdicts(const Trajectory& trajectory,
                                  const std::vector<ContactFacts>& contacts, bool exact_rows);

// Everything in series and impacts; also of a run that was ended early.
Verdict finite_verdict(const Trajectory& trajectory);

}  // namespace rotorub::check
