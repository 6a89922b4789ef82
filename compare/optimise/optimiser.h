// Searches for the values of a study's keys that best meet its goal, using NLopt.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compare/optimise/goal.h"
#include "native_model/scene/reader.h"

namespace rotorub::optimise {

// One evaluated scene.
struct Evaluation {
  std::vector<double> values;                      // one per key, SI
  std::string status;                              // ok, the status of the run, or refused
  std::string reason;                              // empty if ok
  std::optional<double> figure;                    // SI; empty unless ok
  std::vector<std::optional<double>> constraints;  // values of the constraints' figures, SI
  double violation = 0.0;  // >= 0, largest violation of a constraint relative to its limit
  bool ok() const { return status == "ok"; }
};

enum class Ending { kConverged, kEvaluations, kRoundoff, kInterrupted };
const char* to_string(Ending ending);

struct Optimum {
  std::vector<Evaluation> evaluations;  // in order, each point once
  // Index of the best evaluation that violates no constraint by more than kFeasible; empty if each
  // evaluation violates one.
  std::optional<std::size_t> best;
  Ending ending = Ending::kConverged;
  static constexpr double kFeasible = 1e-6;
};

struct OptimiserOptions {
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(const Optimum&)> progress;  // after each evaluation
};

// The scene with these values, one per key of the study.
scene::Scene scene_of(const Task& task, const scene::Variants& variants,
                      const std::vector<double>& values, bool with_text);

// Deterministic: the same scene, goal and start give the same evaluations to the last bit. Throws
// scene::SceneError if the start is refused.
Optimum optimise(const Task& task, const scene::Variants& variants,
                 const OptimiserOptions& options = {});

}  // namespace rotorub::optimise
