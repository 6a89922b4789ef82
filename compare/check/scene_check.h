// `rotorub check`: runs a scene on every engine and judges each run by the scene's rules.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compare/check/verdict.h"
#include "compare/engine/engine.h"
#include "native_model/scene/rules.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub::check {

struct CheckEngine {
  std::string name;    // "native-event"
  std::string column;  // heading in the table: "event"
  scene::RuleEngine word = scene::RuleEngine::kNative;
  bool native = false;      // decides the exit code
  bool exact_rows = false;  // rows satisfy the contact laws to round-off: `event`
  std::shared_ptr<const Engine> engine;
};

// native-event, native-verlet, and MuJoCo with each contact model. `euler` is not checked: it is a
// baseline whose step error is intended.
const std::vector<CheckEngine>& check_engines();

// The rules for this engine. If the scene has none for a MuJoCo engine, the rules for all native
// engines apply to it.
std::vector<scene::Rule> rules_for(const CheckEngine& engine,
                                   const std::vector<scene::Rule>& rules);

// The result of a run: a trajectory, or the refusal that prevented the run.
struct Attempt {
  std::optional<Trajectory> trajectory;
  std::string refusal;  // empty if there is a trajectory
};

// The judged run of a scene on one engine.
struct Case {
  std::string scene, engine;
  bool native = false;
  std::vector<Verdict> verdicts;  // one per rule, the rules for every run first
  Verdict deciding;               // the worst violation; otherwise the first refusal or scene rule

  Outcome outcome() const { return deciding.outcome; }
};

// rules: for this engine (rules_for). reference: for metrics that need one; if it is null,
// their rules are violated. Throws NoSuchMetric. A pure function of its arguments.
//
// A refusal that the rules do not expect is a violation on a native engine; on MuJoCo it is only
// shown. A refusal without a message and a run that diverged are violations on every engine.
Case judge(const scene::Scene& scene, const CheckEngine& engine,
           const std::vector<scene::Rule>& rules, const Attempt& attempt,
           const Trajectory* reference);

// The scene's rules, with checked metric names. Throws scene::SceneError at the rule's place.
std::vector<scene::Rule> rules_of(const scene::Scene& scene);

// progress receives the fraction done and the engine at work. After an interrupt, returns the cases
// completed so far. Throws scene::SceneError for a metric on a column that the scene does not have.
std::vector<Case> check_scene(const scene::Scene& scene, const std::vector<scene::Rule>& rules,
                              const std::function<void(double, const std::string&)>& progress,
                              const std::atomic<bool>* interrupt);

// The cases of a scene that cannot be read, for the reason `refusal`: every engine refuses it.
std::vector<Case> refused_cases(const scene::Scene& scene, const std::vector<scene::Rule>& rules,
                                const std::string& refusal);

// Whether every native case passes or is refused as its file says.
bool holds(const std::vector<Case>& cases);

}  // namespace rotorub::check
