// The rules that a scene file states for its own runs, [[check]]: the expected result, the engine
// and the reason. Neither model reads them; they are not part of the simulation and exist only in
// the scene's text.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "native_model/scene/scene.h"

namespace rotorub::scene {

// In the order of the words in the file. kNative and kMujoco stand for all engines of that kind.
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

// kPass: the run completes. kRefused: it is refused, or ends with a status that says why.
enum class Expect { kPass, kRefused };

struct Rule {
  RuleEngine engine = RuleEngine::kNative;
  std::string metric;              // the measured quantity (compare/check/metric.h); empty: none
  std::optional<double> min, max;  // SI, inclusive; a metric needs at least one
  Expect expect = Expect::kPass;   // kRefused: no metric
  std::string why;                 // one sentence: why the case is hard
};

// The rules in the text of a scene, also of one that was refused, in the order of the file; none
// for a scene made by hand.
std::vector<Rule> read_rules(const Scene& scene);

}  // namespace rotorub::scene
