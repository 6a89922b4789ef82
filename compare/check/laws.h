// The rules of every run, whatever its scene says: everything finite, impacts that push, brake and
// give no energy, friction in its cone, the rotor in its ring. Of `event`, whose rows are exact,
// complementarity and the force of sliding too.
#pragma once

#include <optional>
#include <vector>

#include "compare/check/verdict.h"
#include "compare/metrics/residuals.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub::check {

struct LawLimits {
  // Scaled residual of complementarity, cone and sliding.
  double residual = 1e-10;
  // Energy that an impact gives, over the impulses times the speeds that they worked at: round-off.
  double impact_gain = 1e-12;
  // Share of the clearance. Between its rows a fixed step leaves the circle by a step's curvature,
  // at first touch by a step's flight; beyond the clearance it would be out of range.
  double penetration = 1.0;
};

// Of a run that came to its end.
std::vector<Verdict> law_verdicts(const Trajectory& trajectory,
                                  const std::optional<ContactFacts>& facts, bool exact_rows,
                                  const LawLimits& limits = {});

// Everything in series and impacts; also of a run that was ended early.
Verdict finite_verdict(const Trajectory& trajectory);

}  // namespace rotorub::check
