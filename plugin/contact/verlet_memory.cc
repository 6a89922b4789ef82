#include "plugin/contact/verlet_memory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <tuple>

#include "mjcf/names.h"
#include "plugin/contact/verlet.h"
#include "plugin/model/differentiating.h"
#include "plugin/model/options.h"
#include "plugin/model/thread_memory.h"

namespace rotorub::plugin {

bool actuation_enabled(const mjModel* m) { return !(m->opt.disableflags & mjDSBL_ACTUATION); }

namespace {

// The model that the native step uses. If currents lag, MuJoCo computes the force on the ring. If
// MuJoCo has disabled actuation, there is no force, and no controller that reacts to an impact
// within the step. If it has disabled contacts, the clearance is so large that nothing reaches the
// ring; the memory keeps its size, so that contacts may be switched during a run.
Model plant_of(const Model& model, bool contact, bool actuation) {
  Model plant = model;
  if (model.first().lags() || !actuation) plant = without_controller(with_ideal_actuator(model));
  for (AuxiliaryBearing& at : plant.auxiliary) {
    if (!contact) at.contact->clearance = 1e6;
  }
  return plant;
}

// True if MuJoCo's state equals the remembered one, up to the errors of MuJoCo's arithmetic and of
// its links' small masses. (The remembered state is never used in its place.)
bool remembers(const Config& config, const double* slot, const Coordinates& state) {
  const int n = config.model.nq();
  const double* q = VerletStepper::saved_q(slot);
  double clearance = std::numeric_limits<double>::infinity();  // the smallest
  for (const AuxiliaryBearing& at : config.model.auxiliary)
    clearance = std::min(clearance, at.contact->clearance);
  const auto near = [](double a, double b, double size) {
    return std::abs(a - b) <= 1e-6 * (std::abs(b) + size);
  };
  for (int i = 0; i < n; ++i) {
    if (!near(state.q()[i], q[i], clearance) || !near(state.v()[i], q[n + i], 1.0)) return false;
  }
  return true;
}

// The part of the memory that belongs to the present state.
enum class Known { kNothing, kPass, kStepBefore };

Known known_of(const Config& config, const mjModel* m, const mjData* d, std::size_t size,
               const Coordinates& state) {
  const double h = m->opt.timestep;
  const VerletEntries& entry = verlet_entries(config, d);
  const double* before = slots(config, entry);
  const bool begun = entry.begun == static_cast<double>(size) && entry.step == h;
  const double passed = d->time - entry.time;
  // A nudged state (differences.h) keeps the memory of the original one.
  const auto known = [&](const double* slot) {
    return Differentiating::nudges(d) || remembers(config, slot, state);
  };
  if (begun && passed == 0.0 && known(before)) return Known::kPass;
  if (begun && is_next_step(passed, h, d->time) && known(before + size)) return Known::kStepBefore;
  return Known::kNothing;
}

}  // namespace

VerletWorker& worker_of(const Config& config, const mjModel* m) {
  using Key = std::tuple<double, double, bool, bool>;
  thread_local InTurns<Key, std::unique_ptr<VerletWorker>> known;
  const double h = m->opt.timestep;
  const bool contact = contact_enabled(m), actuation = actuation_enabled(m);
  const Key key{config.id, h, contact, actuation};
  if (const auto* worker = known.find(key)) return **worker;
  Model plant = plant_of(config.model, contact, actuation);
  return *known.add(key, std::make_unique<VerletWorker>(config, h, std::move(plant)));
}

double* slot_of_pass(const Config& config, const mjModel* m, mjData* d, VerletWorker& worker,
                     const Coordinates& state) {
  const std::size_t size = worker.slot();
  VerletEntries& entry = verlet_entries(config, d);
  double* before = slots(config, entry);
  const Known known = known_of(config, m, d, size, state);
  entry.time = d->time;
  entry.step = m->opt.timestep;
  if (known == Known::kStepBefore) std::copy_n(before + size, size, before);
  if (known != Known::kNothing) return before;
  entry.begun = static_cast<double>(size);
  worker.begin(d->time, state.q(), state.v());
  worker.save(before);
  return before;
}

int verlet_loop_data(const Config& config) {
  const Model& model = config.model;
  const std::size_t loop = model.first().loop ? model.first().loop->memory_size() : 0;
  const int end = config.verlet_data +
                  mjcf_names::verlet_data_size(model.nq(), ZeroOrderHold::memory_size(model),
                                               VerletStepper::memory_size(model));
  // In the second slot the memory of the loop ends just before the number of the step.
  return end - 1 - static_cast<int>(loop);
}

const double* velocities_of_pass(const Config& config, const mjData* d) {
  return behind(verlet_entries(config, d));
}

bool begins_anew(const Config& config, const mjModel* m, const mjData* d) {
  const VerletWorker& worker = worker_of(config, m);
  const Known known = known_of(config, m, d, worker.slot(), Coordinates(config, d));
  const double* pass = slots(config, verlet_entries(config, d));
  return known == Known::kNothing || (known == Known::kPass && pass[worker.counter] == 0.0);
}

}  // namespace rotorub::plugin
