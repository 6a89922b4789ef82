#include "plugin/contact/verlet.h"

#include <algorithm>
#include <atomic>

#include "native_model/bearing/actuator.h"
#include "native_model/model/dynamics.h"
#include "plugin/contact/contact_memory.h"
#include "plugin/contact/verlet_memory.h"
#include "plugin/model/actuators.h"
#include "plugin/model/control.h"
#include "plugin/model/generated_rotor.h"
#include "plugin/model/mujoco_actuators.h"
#include "plugin/model/mujoco_versions.h"
#include "plugin/model/options.h"
#include "plugin/model/user_data.h"

namespace rotorub::plugin {
namespace {

thread_local StepWorks* works_of_step = nullptr;

void watch_the_rings(const Config& config, const mjModel* m, mjData* d, const Coordinates& state,
                     bool anew) {
  for (const ContactPair& pair : config.pairs) {
    if (anew) ContactStatus(contact_entries(pair, d).status).begin();
    if (!contact_enabled(m)) continue;
    watch_escape(pair, d, separation(config.model, state.q(), pair.bearing).norm());
  }
}

// f = the forces on the chain other than the native loads and the actuators: those of MuJoCo and of
// other programs. They must not depend on the value of ctrl before the command, not even in the
// last bit.
void foreign_force(const Config& config, const mjModel* m, mjData* d, const Coordinates& state,
                   double* f) {
  const Model& model = config.model;
  const mjtNum* bodies = d->xfrc_applied;
  const bool pulled = std::any_of(bodies, bodies + 6 * m->nbody, [](mjtNum x) { return x != 0.0; });
  if (pulled) {
    std::fill_n(d->qfrc_actuator, m->nv, 0.0);
    mj_fwdAcceleration(m, d);
  }
  for (int i = 0; i < model.nq(); ++i) {
    const int dof = config.dof_address[static_cast<std::size_t>(i)];
    const double own = model.stiffness[i] * state.q()[i] + model.damping[i] * state.v()[i];
    f[i] = pulled ? d->qfrc_smooth[dof]
                  : d->qfrc_passive[dof] - d->qfrc_bias[dof] + d->qfrc_applied[dof];
    f[i] += own;
  }
}

// f += the forces of the actuators that do not belong to the bearing.
void add_other_actuators(const Config& config, const mjModel* m, mjData* d, double* f) {
  const Model& model = config.model;
  const bool bearing = config.actuator[0] >= 0 && config.actuator[1] >= 0;
  if (actuator_count(m) <= (bearing ? 2 : 0)) return;
  compute_actuators(m, d);
  const Eigen::Vector2d ours = actuator_state(config, m, d).force;
  for (int i = 0; i < model.nq(); ++i) {
    f[i] += d->qfrc_actuator[config.dof_address[static_cast<std::size_t>(i)]];
  }
  const int ring = model.first().ring;
  for (int k = 0; ring != kAbsent && k < 2; ++k) f[ring + k] -= ours[k];
}

// The mean command about this instant, in the form that the native step needs. ctrl receives the
// held command.
Eigen::Vector2d command(const Config& config, const mjModel* m, mjData* d, const Coordinates& state,
                        VerletWorker& worker) {
  const Model& model = config.model;
  const double h = m->opt.timestep, t = d->time;
  const AuxiliaryBearing& ring = model.first();
  // True if the force follows the command: no lag, and actuation is enabled.
  const bool asks = !ring.lags() && actuation_enabled(m);
  Eigen::Vector2d mean{0.0, 0.0};
  if (ring.controller) {
    mean = worker.hold.held();
    const double end = t + 0.5 * h;
    if (worker.hold.needs_state(end)) {
      double v[kMaxCoordinates], a[kMaxCoordinates];
      const Eigen::Vector2d held_force =
          asks ? worker.hold.held() : actuator_state(config, m, d).force;
      worker.stepper.velocity_now(worker.next, held_force, v);
      const bool first = worker.next == 0;
      for (int i = 0; i < model.nq(); ++i) a[i] = first ? 0.0 : 2.0 / h * (v[i] - state.v()[i]);
      if (ring.lags()) worker.hold.show_currents(actuator_state(config, m, d).current);
      mean = worker.hold.mean(first ? t : t - 0.5 * h, t, end, state.q(), v, a);
      if (asks) worker.stepper.announce_command_jump(worker.hold.command_jump());
    }
    if (const std::string& why = worker.hold.failure(); !why.empty()) controller_failed(d, why);
    const Eigen::Vector2d held = worker.hold.held();
    const Eigen::Vector2d commanded = ring.magnets ? held : to_axes(held);
    for (int k = 0; k < 2; ++k) d->ctrl[control_address(m, config.actuator[k])] = commanded[k];
  }
  ModelEntries& entry = model_entries(config, d);
  entry.held_x = mean.x();
  entry.held_y = mean.y();
  compute_actuators(m, d);
  if (ring.controller && asks) return mean;
  const ActuatorState now = actuator_state(config, m, d);
  return ring.magnets && asks ? now.current : now.force;
}

void note(const ContactPair& pair, mjData* d, const FixedStep& r, double kick) {
  ContactEntries& entry = contact_entries(pair, d);
  const ContactStep& did = r.contacts[pair.bearing];
  record_forces(entry, did.mode, did.normal_impulse / kick + did.impact_force.x(),
                did.friction_impulse / kick + did.impact_force.y());
  ContactStatus(entry.status).record(r.status);
  entry.impact = 0.0;
  for (const Impact& impact : r.impacts) {
    if (static_cast<std::size_t>(impact.contact) != pair.bearing) continue;
    if (entry.impact == 0.0) {
      entry.impact = 1.0;
      entry.impact_time = impact.t;
      entry.gap_rate_before = impact.gap_rate_before;
      entry.slip_before = impact.slip_before;
    }
    entry.gap_rate_after = impact.gap_rate_after;
    entry.slip_after = impact.slip_after;
  }
}

// Records the normal of the forces. For an impact within the step it is the normal at the time of
// the impact, which the rotor reaches with the present velocities v.
void note_place(const Config& config, const ContactPair& pair, const mjData* d,
                const Coordinates& state, const double* v) {
  const ContactEntries& entry = contact_entries(pair, d);
  const double until = entry.impact != 0.0 ? entry.impact_time - d->time : 0.0;
  double q[kMaxCoordinates];
  for (int i = 0; i < config.model.nq(); ++i) q[i] = state.q()[i] + until * v[i];
  const Eigen::Vector2d there = separation(config.model, q, pair.bearing);
  if (there.norm() > kNoNormal) note_contact(d, pair.userdata, there.normalized());
}

// If the flag is set, MuJoCo does not call mjcb_passive, but the native step still has its loads.
void warn_of_disabled_passive(const mjModel* m) {
  if (!passive_disabled(m)) return;
  static std::atomic<bool> warned = false;
  if (warned.exchange(true)) return;
  warn(
      "rotorub: <flag passive=\"disable\">: springs and dampers of the joints are off; with "
      "contact model `rigid` the scene's other loads still act (excitation, unbalance, gyroscopic, "
      "weight)");
}

}  // namespace

void record_works(StepWorks* to) { works_of_step = to; }

void apply_verlet(const Config& config, const mjModel* m, mjData* d, const Coordinates& state) {
  warn_of_disabled_passive(m);
  const Model& model = config.model;
  const int n = model.nq();
  const double h = m->opt.timestep;
  VerletEntries& entry = verlet_entries(config, d);
  VerletWorker& worker = worker_of(config, m);
  worker.load(slot_of_pass(config, m, d, worker, state));
  worker.stepper.adopt(state.q(), state.v());
  watch_the_rings(config, m, d, state, worker.next == 0);

  double foreign[kMaxCoordinates], loads[kMaxCoordinates];
  foreign_force(config, m, d, state, foreign);
  std::copy_n(foreign, n, loads);
  add_other_actuators(config, m, d, loads);
  worker.stepper.apply(loads);
  const Eigen::Vector2d u = command(config, m, d, state, worker);
  const FixedStep r = worker.stepper.step(worker.next, u, works_of_step != nullptr);
  if (works_of_step) *works_of_step = {r.contact_work, r.impact_work, r.external_work};
  const double kick = worker.stepper.last_kick() * h;
  for (const ContactPair& pair : config.pairs) note(pair, d, r, kick);
  if (r.status != Status::kOk) return;  // this step has neither native loads nor contact
  std::copy_n(worker.stepper.last_velocity(), n, behind(entry));
  for (const ContactPair& pair : config.pairs) {
    if (!(contact_entries(pair, d).normal_force > 0.0)) continue;
    note_place(config, pair, d, state, behind(entry));
  }
  ++worker.next;
  worker.save(slots(config, entry) + worker.slot());

  // The passive force with which MuJoCo's step has the same result. It uses MuJoCo's own mass
  // matrix, because MuJoCo's links weigh a little, and the masses that they carry may be small too.
  StackFrame room(d);
  const auto all = static_cast<int>(m->nv);
  mjtNum* change = room.numbers(all);
  mjtNum* momentum = room.numbers(all);
  mju_zero(change, all);
  const double* v = worker.stepper.v();
  for (int i = 0; i < n; ++i)
    change[config.dof_address[static_cast<std::size_t>(i)]] = v[i] - state.v()[i];
  mj_mulM(m, d, momentum, change);
  for (int i = 0; i < n; ++i) {
    const int dof = config.dof_address[static_cast<std::size_t>(i)];
    const double others = foreign[i] - model.stiffness[i] * state.q()[i] -
                          model.damping[i] * state.v()[i] + d->qfrc_actuator[dof];
    const double damped = damped_step(m) * model.damping[i] * change[dof];
    d->qfrc_passive[dof] += (momentum[dof] + damped) / h - others;
  }
}

}  // namespace rotorub::plugin
