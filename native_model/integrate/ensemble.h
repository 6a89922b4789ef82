// Many runs of one scene at once by the paper's time stepping, for sweeps: lanes::kWidth of them
// in the vector registers of one core, each with values of its own. A run's bits are those of the
// run alone.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "native_model/system/model.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// What is kept of each run.
struct EnsembleRun {
  Status status = Status::kOk;
  double first_touch = -1.0;        // s; -1: never touched
  std::int64_t contact_steps = 0;   // steps with a normal impulse
  std::int64_t impacts = 0;         // with gap_rate_before < kCountedGapRate
  double impulse_total = 0.0;       // N s
  double peak_impulse = 0.0;        // N s, largest of one step
  std::vector<double> q, v;         // at the end, nq each
  double contact_fraction(double end, double step) const;
  double mean_force(double end) const;  // N, from first touch to the end
};

// True where two models have the same coordinates and parts, so that they can be lanes of one
// kernel.
bool same_structure(const Model& a, const Model& b);

class Ensemble {
 public:
  // All of the same structure; throws std::invalid_argument naming the first that is not. Models
  // are copied. step: s, > 0.
  Ensemble(std::vector<Model> models, double step);
  ~Ensemble();

  // All runs from t = 0 over `steps` steps; controllers are evaluated run by run.
  std::vector<EnsembleRun> run(std::int64_t steps);

 private:
  std::vector<Model> models_;
  double step_;
};

}  // namespace rotorub
