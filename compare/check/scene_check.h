// `rotorub check`: a scene on every engine, each run judged by the scene's rules.
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
  std::string column;  // of the table: "event"
  scene::RuleEngine word = scene::RuleEngine::kNative;
  bool native = false;      // decides the exit code
  bool exact_rows = false;  // rows obey the laws to round-off: `event`
  std::shared_ptr<const Engine> engine;
};

// native-event, native-verlet, and MuJoCo with each contact model. (`euler` is a baseline that is
// there to be wrong by its step, and is not checked.)
const std::vector<CheckEngine>& check_engines();

// The rules for this engine. Of MuJoCo, where the scene has none for it: those for every native
// one, so that its results are measured by what they should be.
std::vector<scene::Rule> rules_for(const CheckEngine& engine,
                                   const std::vector<scene::Rule>& rules);

// What a run left: a trajectory, or the refusal that kept it from beginning.
struct Attempt {
  std::optional<Trajectory> trajectory;
  std::string refusal;  // where there is no trajectory
};

// A scene on an engine, judged.
struct Case {
  std::string scene, engine;
  bool native = false;
  std::vector<Verdict> verdicts;  // of each rule, those of every run first
  Verdict deciding;               // the worst violation; else what the file limits first

  Outcome outcome() const { return deciding.outcome; }
};

// `rules`: of this engine (rules_for). `reference`: for metrics that need one; null where it could
// not be had, and then they are violated. Throws NoSuchMetric. A pure function of what the run
// left.
//
// A refusal where the rules expect none is a violation natively; MuJoCo's is shown as it is. A
// status without a message, and a run that diverged, are violations everywhere.
Case judge(const scene::Scene& scene, const CheckEngine& engine,
           const std::vector<scene::Rule>& rules, const Attempt& attempt,
           const Trajectory* reference);

// Its rules, each metric of a known name. Throws scene::SceneError with the rule's place.
std::vector<scene::Rule> rules_of(const scene::Scene& scene);

// `progress`: share done and the engine that is at work. Stops after the engine at work once
// `interrupt` is true, and gives the cases so far. Throws scene::SceneError for a metric on a
// column that the scene does not have.
std::vector<Case> check_scene(const scene::Scene& scene, const std::vector<scene::Rule>& rules,
                              const std::function<void(double, const std::string&)>& progress,
                              const std::atomic<bool>* interrupt);

// Of a scene that cannot even be read, for the reason of `refusal`: refused by every engine.
std::vector<Case> refused_cases(const scene::Scene& scene, const std::vector<scene::Rule>& rules,
                                const std::string& refusal);

// Every native case passes, or is refused as its file says.
bool holds(const std::vector<Case>& cases);

}  // namespace rotorub::check
