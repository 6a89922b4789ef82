// The memory of the native step (verlet.h) in mjData.userdata, and the stepper that works on it.
#pragma once

#include <mujoco/mujoco.h>

#include <cstddef>
#include <cstdint>
#include <utility>

#include "native_model/stepping/stepper.h"
#include "native_model/stepping/zero_order_hold.h"
#include "plugin/model/config.h"
#include "plugin/model/generated_rotor.h"
#include "plugin/model/user_data.h"

namespace rotorub::plugin {

bool actuation_enabled(const mjModel* m);

// Takes the steps. Between two calls it holds only working memory.
struct VerletWorker {
  VerletWorker(const Config& config, double h, Model moved)
      : model(config.model),
        plant(std::move(moved)),
        stepper(plant, h),
        hold(model),
        memory(VerletStepper::memory_size(plant)),
        counter(memory + ZeroOrderHold::memory_size(model)) {}

  std::size_t slot() const { return counter + 1; }
  void load(const double* slot) {
    stepper.restore(slot);
    hold.restore(slot + memory);
    next = static_cast<std::int64_t>(slot[counter]);
  }
  void save(double* slot) const {
    stepper.save(slot);
    hold.save(slot + memory);
    slot[counter] = static_cast<double>(next);
  }
  void begin(double t, const double* q, const double* v) {
    stepper.begin(t, q, v);
    hold = ZeroOrderHold(model);
    next = 0;
  }

  const Model model, plant;
  VerletStepper stepper;
  ZeroOrderHold hold;
  std::size_t memory, counter;  // positions of the hold and of the number of the step in a slot
  std::int64_t next = 0;
};

// This thread's worker for the model and MuJoCo's present step and flags.
VerletWorker& worker_of(const Config& config, const mjModel* m);

// The entries in userdata.
template <typename Data>
auto& verlet_entries(const Config& config, Data* d) {
  return entries<VerletEntries>(d, config.verlet_data);
}
// The velocities of the pass (nq) follow the entries, and then the two slots: the slot of the pass,
// and the slot of the state after its step.
template <typename Entries>
auto* slots(const Config& config, Entries& entry) {
  return behind(entry) + config.model.nq();
}

// Prepares the slot of this pass and returns it.
double* slot_of_pass(const Config& config, const mjModel* m, mjData* d, VerletWorker& worker,
                     const Coordinates& state);

}  // namespace rotorub::plugin
