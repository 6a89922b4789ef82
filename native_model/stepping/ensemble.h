// Many runs of one scene at once by `verlet`, for sweeps: as many as fit into the vector
// registers of one core, each with values of its own. A run's bits are those of the run alone, on
// every instruction set.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "native_model/system/model.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// What is kept of each run.
struct EnsembleRun {
  Status status = Status::kOk;
  double first_touch = -1.0;  // s, begin of the step; -1: never touched
  double contact_steps =
      0.0;  // with a normal impulse; an impact that takes time: those of its duration
  // The end lies in the middle of a step in lasting contact, half of which counts.
  bool ends_in_contact = false;
  std::int64_t impacts = 0;      // with gap_rate_before < kCountedGapRate
  double impulse_total = 0.0;    // N s
  double peak_impulse = 0.0;     // N s, largest of one step, were its force that of a whole one
  double peak_impact = 0.0;      // N s, largest of one impact
  double friction_work = 0.0;    // J, <= 0
  double max_penetration = 0.0;  // m
  std::vector<double> q, v;      // at the end, nq each
  double contact_fraction(double end, double step) const;
  double mean_force(double end) const;  // N, from first touch to the end
};

// What is seen of a run on its way, at t = k step.
struct EnsembleLook {
  std::size_t run = 0;
  std::int64_t k = 0;
  const double *q = nullptr, *v = nullptr;  // nq each
  double normal_force = 0.0;  // N, of the step that ended there; of impacts: of one under way
  std::int64_t impacts = 0;   // counted ones so far
};
struct EnsembleWatch {
  std::vector<std::int64_t> steps;                // k, ascending, in [0, the last step]
  std::function<void(const EnsembleLook&)> look;  // every run at each of them
  const std::atomic<bool>* interrupt = nullptr;   // true: stop; the status of what is left says so
  bool stopped() const { return interrupt && interrupt->load(std::memory_order_relaxed); }
};

// Of x86 processors; elsewhere there is kBaseline alone (on x86: SSE2).
enum class InstructionSet { kBaseline, kAvx2, kAvx512 };
InstructionSet best_instruction_set();  // of this processor

class Ensemble {
 public:
  // All of the same structure (stepping/lane_model.h); throws std::invalid_argument naming the
  // first that is not. Models are copied. step: s, > 0. `set`: not beyond best_instruction_set().
  Ensemble(std::vector<Model> models, double step, InstructionSet set = best_instruction_set());

  // All runs from t = 0 over `steps` steps; controllers are evaluated run by run.
  std::vector<EnsembleRun> run(std::int64_t steps, const EnsembleWatch& watch = {});

 private:
  std::vector<Model> models_;
  double step_;
  InstructionSet set_;
};

}  // namespace rotorub
