// The pass rules that a scene's file states about its own runs, [[check]]: what has to come out, on
// which engine, and why. Neither model reads them: they are no part of what is simulated, and stand
// in the scene's text alone.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "native_model/scene/record.h"
#include "native_model/scene/scene.h"

namespace rotorub::scene {

// In the order of the words in the file: kNative and kMujoco stand for all of theirs.
enum class RuleEngine {
  kNative,
  kNativeEvent,
  kNativeVerlet,
  kMujoco,
  kMujocoRigid,
  kMujocoCoulomb,
  kMujocoCone,
  kMujocoConeCoulomb
};

// kPass: the run comes to its end. kRefused: it is not begun, or ended with a status that says why.
enum class Expect { kPass, kRefused };

struct Rule {
  RuleEngine engine = RuleEngine::kNative;
  std::string metric;              // what is measured (compare/check/metric.h); empty: nothing
  std::optional<double> min, max;  // SI, inclusive; a metric has one of them at least
  Expect expect = Expect::kPass;   // kRefused: no metric
  std::string why;                 // a sentence: why the case is hard
};

// Of a scene that was read; in the order of the file. None of a scene made by hand.
std::vector<Rule> read_rules(const Scene& scene);

// Contradictions within single rules.
void check_rules(const std::vector<Rule>& rules, const Record& record,
                 std::vector<Diagnostic>& diagnostics);

}  // namespace rotorub::scene
