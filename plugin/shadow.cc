#include "plugin/shadow.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "mjcf/names.h"
#include "native_model/model/dynamics.h"
#include "native_model/stepping/step_limit.h"
#include "native_model/stepping/stepper.h"
#include "native_model/stepping/zero_order_hold.h"
#include "plugin/model/contact_sensors.h"
#include "plugin/model/control.h"
#include "plugin/model/generated_rotor.h"
#include "plugin/model/message.h"
#include "plugin/model/mujoco_versions.h"
#include "plugin/model/thread_memory.h"
#include "plugin/model/user_data.h"

namespace rotorub::plugin {
namespace {

// Takes the steps. Between two calls it holds only working memory: the state comes from userdata
// and is written back there.
struct Worker {
  Worker(const Config& config, double h)
      : model(config.shadow->model), stepper(model, h), hold(model) {}

  const Model model;
  VerletStepper stepper;
  ZeroOrderHold hold;
};

double* hold_memory(ShadowEntries& entry) { return behind(entry); }
double* stepper_memory(const Config& config, ShadowEntries& entry) {
  return behind(entry) + ZeroOrderHold::memory_size(config.shadow->model);
}

void move_ghosts(const Config& config, mjData* d) {
  const double* q = shadow_state(config, d);
  const auto move = [d](int address, const Eigen::Vector2d& to) {
    if (address < 0) return;
    d->mocap_pos[address] = to.x();
    d->mocap_pos[address + 1] = to.y();
  };
  const ShadowConfig& shadow = *config.shadow;
  move(shadow.ghost_rotor, rotor_point(shadow.model, q));
  move(shadow.ghost_ring, ring_centre(shadow.model, q));
}

void stop(ShadowEntries& entry, Status status, const char* warning) {
  if (entry.status == static_cast<double>(status)) return;
  entry.status = static_cast<double>(status);
  entry.normal = entry.friction = 0.0;
  warn(warning);
}

void say_edited(ShadowEntries& entry) {
  if (entry.edited != 0.0) return;
  entry.edited = 1.0;
  mju_warning("rotorub: shadow: mjModel was edited: the shadow restarts from MuJoCo's state");
}

// MuJoCo's state in the coordinates of the shadow's model, including those of its coils, whose
// rates are the currents.
void mujoco_state(const Config& config, const mjModel* m, const mjData* d, double* q, double* v) {
  const Layout& l = config.shadow->model.layout;
  const Coordinates state(config, d);
  std::copy_n(state.q(), l.coil(), q);
  std::copy_n(state.v(), l.coil(), v);
  for (int k = 0; k < l.coils; ++k) {
    q[l.coil() + k] = 0.0;
    v[l.coil() + k] = coil_current(m, d, config.actuator[k]);
  }
}

void begin(const Config& config, const mjModel* m, mjData* d, ShadowEntries& entry) {
  const double h = m->opt.timestep;
  entry.begun = config.shadow->mark;
  entry.time = entry.origin = d->time;
  entry.step = h;
  entry.steps = 0.0;
  entry.normal = entry.friction = 0.0;
  Worker& worker = thread_worker<Worker>(config, h);
  double q[kMaxCoordinates], v[kMaxCoordinates];
  mujoco_state(config, m, d, q, v);
  worker.stepper.begin(d->time, q, v);
  worker.stepper.save(stepper_memory(config, entry));
  ZeroOrderHold(worker.model).save(hold_memory(entry));
  move_ghosts(config, d);
  // The model was made for a smaller step, which the user has changed since.
  if (!step_refusal(worker.model, h).empty()) {
    stop(entry, Status::kStepTooLarge,
         "rotorub: shadow: <option timestep> is beyond 2 / omega_max of the native model: the "
         "shadow has stopped");
  } else {
    entry.status = static_cast<double>(Status::kOk);
  }
}

constexpr const char* kFailed = "rotorub: shadow: its controller failed: the shadow has stopped";

// The mean command of its own controller about t, where step k begins.
Eigen::Vector2d own_command(Worker& worker, std::int64_t k, double t, double h) {
  ZeroOrderHold& hold = worker.hold;
  VerletStepper& stepper = worker.stepper;
  const double end = t + 0.5 * h;
  if (!hold.needs_state(end)) return hold.held();
  double v[kMaxCoordinates], a[kMaxCoordinates] = {};
  stepper.velocity_now(k, hold.held(), v);
  for (int i = 0; k > 0 && i < worker.model.nq(); ++i) a[i] = 2.0 / h * (v[i] - stepper.v()[i]);
  const Eigen::Vector2d u = hold.mean(k == 0 ? t : t - 0.5 * h, t, end, stepper.q(), v, a);
  stepper.announce_command_jump(hold.command_jump());
  return u;
}

void step(const Config& config, const mjModel* m, mjData* d, ShadowEntries& entry) {
  const double h = m->opt.timestep;
  Worker& worker = thread_worker<Worker>(config, h);
  worker.stepper.restore(stepper_memory(config, entry));
  const auto k = static_cast<std::int64_t>(entry.steps);

  Eigen::Vector2d u = actuator_state(config, m, d).force;
  if (worker.model.first().controller) {
    worker.hold.restore(hold_memory(entry));
    u = own_command(worker, k, entry.origin + entry.steps * h, h);
    worker.hold.save(hold_memory(entry));
    if (!worker.hold.failure().empty()) {
      stop(entry, Status::kControllerFailed, kFailed);
      return;
    }
  }
  FixedStep done;
  try {
    done = worker.stepper.step(k, u);
  } catch (const ControllerError&) {
    stop(entry, Status::kControllerFailed, kFailed);
    return;
  }
  if (done.status != Status::kOk) {
    stop(entry, done.status,
         done.status == Status::kDiverged
             ? "rotorub: shadow: the state is no longer finite: the shadow has stopped"
             : "rotorub: shadow: the contact laws have no unique solution (Painleve): the shadow "
               "has stopped");
    return;
  }
  worker.stepper.save(stepper_memory(config, entry));
  entry.steps += 1.0;
  const double kick = worker.stepper.last_kick() * h;
  entry.normal = done.contacts[0].normal_impulse / kick;
  entry.friction = done.contacts[0].friction_impulse / kick;
  move_ghosts(config, d);
}

}  // namespace

void advance_shadow(const Config& config, const mjModel* m, mjData* d) {
  ShadowEntries& entry = entries<ShadowEntries>(d, config.shadow->userdata);
  const double h = m->opt.timestep, margin = time_tolerance(h, d->time);
  const double passed = d->time - entry.time;
  const bool same_time = std::abs(passed) <= margin;
  const bool runs = entry.status == static_cast<double>(Status::kOk);
  const bool edited = entry.begun != 0.0 && entry.begun != config.shadow->mark;
  if (edited) say_edited(entry);
  if (entry.begun == 0.0 || edited || entry.step != h ||
      (same_time && runs && entry.steps == 0.0)) {
    begin(config, m, d, entry);
    return;
  }
  if (same_time || (passed > 0.0 && passed < h - margin)) return;
  if (!is_next_step(passed, h, d->time)) {
    begin(config, m, d, entry);
    return;
  }
  entry.time = d->time;
  if (runs) step(config, m, d, entry);
}

const double* shadow_state(const Config& config, const mjData* d) {
  const auto& entry = entries<ShadowEntries>(d, config.shadow->userdata);
  return VerletStepper::saved_q(behind(entry) + ZeroOrderHold::memory_size(config.shadow->model));
}

namespace names = mjcf_names;

void map_shadow(const mjModel* m, ShadowConfig& s) {
  const std::string refusal = step_refusal(s.model, m->opt.timestep);
  if (!refusal.empty()) {
    refuse(text_element(names::kSceneText), message("mujoco.shadow: the native model cannot run "
                                                    "alongside: {}; lower run.step, or set false",
                                                    refusal));
  }
  s.gap = sensor_address(m, names::kShadowGap, 1);
  s.normal_force = sensor_address(m, names::kShadowNormalForce, 1);
  s.friction_force = sensor_address(m, names::kShadowFrictionForce, 1);
  s.rotor = sensor_address(m, names::kShadowRotor, 2);
  s.stator = sensor_address(m, names::kShadowStator, 2);
  s.mujoco_rotor = sensor_address(m, names::kRotorPosition, 2);
  const auto ghost = [m](const char* name) {
    const int body = mj_name2id(m, mjOBJ_BODY, name);
    return body < 0 || m->body_mocapid[body] < 0 ? -1 : 3 * m->body_mocapid[body];
  };
  s.ghost_rotor = ghost(names::kGhostRotor);
  s.ghost_ring = ghost(names::kGhostRing);
}

double mark_of(const Model& model) {
  std::uint64_t hash = 14695981039346656037ULL;
  const auto add = [&hash](const double* x, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(x[i])) * 1099511628211ULL;
    }
  };
  for (const auto* list : {&model.mass, &model.stiffness, &model.damping, &model.weight}) {
    add(list->data(), static_cast<std::size_t>(list->size()));
  }
  for (const AuxiliaryBearing& at : model.auxiliary) {
    if (const auto& contact = at.contact) {
      for (const double* x :
           {&contact->radius, &contact->clearance, &contact->friction.coefficient}) {
        add(x, 1);
      }
    }
    add(&at.force_limit, 1);
    if (at.magnets) add(&at.magnets->current_limit, 1);
  }
  return 1.0 + static_cast<double>(hash >> 12);
}

}  // namespace rotorub::plugin
