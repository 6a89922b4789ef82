// One case: a scene on an engine, judged. A pure function of what the run left.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/check/engines.h"
#include "compare/check/verdict.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub::check {

// What a run left: a trajectory, or the refusal that kept it from beginning.
struct Attempt {
  std::optional<Trajectory> trajectory;
  std::string refusal;  // where there is no trajectory
};

struct Case {
  std::string scene, engine;
  bool native = false;
  std::vector<Verdict> verdicts;  // of each rule, those of every run first
  Verdict deciding;               // the worst violation; else what the file limits first

  Outcome outcome() const { return deciding.outcome; }
};

// `rules`: of this engine (rules_for). `reference`: for metrics that need one; null where it could
// not be had, and then they are violated. Throws NoSuchMetric.
//
// A refusal where the rules expect none is a violation natively; MuJoCo's is shown as it is. A
// status without a message, and a run that diverged, are violations everywhere.
Case judge(const scene::Scene& scene, const CheckEngine& engine,
           const std::vector<scene::Rule>& rules, const Attempt& attempt,
           const Trajectory* reference);

}  // namespace rotorub::check
