// Searches the values of a study's keys for the best of its goal, by NLopt.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/optimise/goal.h"
#include "native_model/scene/reader.h"

namespace rotorub::optimise {

// One scene that was tried.
struct Evaluation {
  std::vector<double> values;                      // of each key, SI
  std::string status;                              // ok, of a run, or refused
  std::string reason;                              // why it is not ok
  std::optional<double> figure;                    // SI; nothing: not ok
  std::vector<std::optional<double>> constraints;  // figures of the constraints, SI
  double violation = 0.0;  // >= 0, the most by which a constraint is broken, over its limit
  bool ok() const { return status == "ok"; }
};

enum class Ending { kConverged, kEvaluations, kRoundoff, kInterrupted };
const char* to_string(Ending ending);

struct Optimum {
  std::vector<Evaluation> evaluations;  // in their order, each point once
  std::optional<std::size_t> best;      // of these: the best that breaks no constraint by more
                                        // than kFeasible; nothing: none
  Ending ending = Ending::kConverged;
  static constexpr double kFeasible = 1e-6;
};

struct OptimiserOptions {
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(const Optimum&)> progress;  // after each evaluation
};

// The scene of values, one for each key of the study.
scene::Scene scene_of(const Task& task, const scene::Variants& variants,
                      const std::vector<double>& values, bool with_text);

// The same scene, goal and start give the same evaluations, to the last bit. Throws
// scene::SceneError where the start is refused.
Optimum optimise(const Task& task, const scene::Variants& variants,
                 const OptimiserOptions& options = {});

}  // namespace rotorub::optimise
