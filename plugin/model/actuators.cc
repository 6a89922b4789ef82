#include "plugin/model/actuators.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "plugin/model/message.h"
#include "plugin/model/mujoco_actuators.h"
#include "plugin/model/mujoco_versions.h"

namespace rotorub::plugin {
namespace {

constexpr int kKinds = 3;  // number of values of ActuatorQuestion

std::size_t place_of(ActuatorQuestion asked, int id) {
  return static_cast<std::size_t>(kKinds * id + static_cast<int>(asked));
}

enum class Answer : char {
  kNone,
  kFresh,  // MuJoCo has not asked for it yet
  kUsed,   // MuJoCo has asked for it
};

// The pass that this thread is in.
struct Pass {
  const mjData* data = nullptr;
  bool asking = false;    // compute_actuators is running
  bool computed = false;  // with `inputs`
  std::vector<mjtNum> inputs;
  std::vector<mjtNum> values;  // kKinds for each actuator
  std::vector<Answer> answers;
  std::vector<mjtNum> plugin_state;  // as it was at the beginning of the pass
  bool plugin_state_kept = false;
  std::vector<mjtNum> forces;  // of engine plugins
};
thread_local Pass pass;

std::atomic<bool> preloaded = false;

// Calls action(values, count) for all data that the answers depend on.
template <typename Action>
void for_each_input(const mjModel* m, const mjData* d, Action action) {
  action(&d->time, 1);
  action(d->ctrl, count(m->nu));
  action(d->act, count(m->na));
  action(d->qpos, count(m->nq));
  action(d->qvel, count(m->nv));
}

void keep_inputs(const mjModel* m, const mjData* d, std::vector<mjtNum>& inputs) {
  inputs.resize(static_cast<std::size_t>(1 + m->nu + m->na + m->nq + m->nv));
  mjtNum* to = inputs.data();
  for_each_input(m, d, [&to](const mjtNum* values, int n) {
    for (int i = 0; i < n; ++i) *to++ = values[i];
  });
}

bool has_inputs(const mjModel* m, const mjData* d, const std::vector<mjtNum>& inputs) {
  if (inputs.size() != static_cast<std::size_t>(1 + m->nu + m->na + m->nq + m->nv)) return false;
  const mjtNum* at = inputs.data();
  bool same = true;
  for_each_input(m, d, [&](const mjtNum* values, int n) {
    for (int i = 0; i < n; ++i) same &= *at++ == values[i];
  });
  return same;
}

void restore_plugin_state(const mjModel* m, mjData* d) {
  const std::span<mjtNum> state = plugin_state(m, d);
  std::copy_n(pass.plugin_state.begin(), state.size(), state.begin());
}

}  // namespace

void begin_actuators(const mjData* d) {
  pass.data = d;
  pass.asking = pass.computed = pass.plugin_state_kept = false;
  std::fill(pass.answers.begin(), pass.answers.end(), Answer::kNone);
}

// Answers that MuJoCo received at this state stay known.
ActuatorsAside::ActuatorsAside(const mjModel* m, mjData* d) : m_(m), d_(d) {
  if (pass.data != d || !has_inputs(m, d, pass.inputs)) begin_actuators(d);
  pass.computed = pass.plugin_state_kept = false;
}
ActuatorsAside::~ActuatorsAside() {
  if (pass.data == d_ && pass.plugin_state_kept) restore_plugin_state(m_, d_);
  pass.computed = pass.plugin_state_kept = false;
}

void compute_actuators(const mjModel* m, mjData* d) {
  const int actuators = actuator_count(m);
  if (actuators == 0) return;
  Pass& now = pass;
  if (now.data != d) begin_actuators(d);
  if (now.computed && has_inputs(m, d, now.inputs)) return;
  const std::size_t room = static_cast<std::size_t>(kKinds) * static_cast<std::size_t>(actuators);
  if (now.answers.size() < room) {
    now.answers.assign(room, Answer::kNone);
    now.values.resize(room);
  }
  const bool engine = has_engine_actuators(m);
  if (engine) {
    // If there are several computations in a pass, each begins with the same plugin state.
    if (now.plugin_state_kept) {
      restore_plugin_state(m, d);
    } else {
      const std::span<const mjtNum> state = plugin_state(m, d);
      now.plugin_state.assign(state.begin(), state.end());
      now.plugin_state_kept = true;
    }
  }
  now.asking = true;
  mj_fwdActuation(m, d);
  now.asking = false;
  now.computed = true;
  keep_inputs(m, d, now.inputs);
  if (!engine) return;
  now.forces.clear();
  for (int i = 0; i < actuators; ++i) now.forces.push_back(d->actuator_force[force_address(m, i)]);
  if (!preloaded) restore_plugin_state(m, d);
}

bool actuators_computed(const mjModel* m, mjData* d) {
  Pass& now = pass;
  if (!preloaded || now.data != d || now.asking || !now.computed) return false;
  now.computed = false;
  if (has_inputs(m, d, now.inputs)) return true;
  if (has_engine_actuators(m)) restore_plugin_state(m, d);
  return false;
}

void allow_edits(const mjModel* m, const mjData* d) {
  if (pass.data == d && !has_engine_actuators(m)) pass.computed = false;
}

void set_preloaded() { preloaded = true; }
bool is_preloaded() { return preloaded; }

void compare_actuators(const mjModel* m, const mjData* d) {
  static std::atomic<bool> warned = false;
  if (pass.data != d || !pass.computed || !has_engine_actuators(m) || warned ||
      !has_inputs(m, d, pass.inputs))
    return;
  for (int i = 0; i < actuator_count(m); ++i) {
    const double force = pass.forces[static_cast<std::size_t>(i)];
    if (!is_engine_actuator(m, i) || d->actuator_force[force_address(m, i)] == force) continue;
    if (warned.exchange(true)) return;
    const char* name = m->names + m->name_actuatoradr[i];
    const std::string text = message(
        "rotorub: <plugin name=\"{}\"> of <actuator> gives another force when it is computed again "
        "within a step, but the contact needs it before MuJoCo does; keep its state in "
        "mjData.plugin_state or act, or preload rotorub's plugin (LD_PRELOAD)",
        name);
    warn(text.c_str());
    return;
  }
}

bool answer_given(ActuatorQuestion asked, const mjModel* m, const mjData* d, int id,
                  mjtNum& value) {
  const std::size_t at = place_of(asked, id);
  if (pass.data != d || at >= pass.answers.size() || pass.answers[at] == Answer::kNone)
    return false;
  if (!pass.asking) {
    // MuJoCo asks.
    if (pass.answers[at] == Answer::kUsed || !has_inputs(m, d, pass.inputs)) return false;
    pass.answers[at] = Answer::kUsed;
  }
  value = pass.values[at];
  return true;
}

void keep_answer(ActuatorQuestion asked, const mjData* d, int id, mjtNum value) {
  if (!pass.asking || pass.data != d) return;
  const std::size_t at = place_of(asked, id);
  pass.answers[at] = Answer::kFresh;
  pass.values[at] = value;
}

void update_smooth_force(const mjModel* m, mjData* d) {
  compute_actuators(m, d);
  const mjtNum* applied = d->xfrc_applied;
  if (std::any_of(applied, applied + 6 * m->nbody, [](mjtNum f) { return f != 0.0; })) {
    mj_fwdAcceleration(m, d);
    return;
  }
  // Only the sum is needed; the accelerations are not.
  for (int i = 0; i < m->nv; ++i) {
    const mjtNum actuator = actuator_count(m) > 0 ? d->qfrc_actuator[i] : 0.0;
    d->qfrc_smooth[i] = d->qfrc_passive[i] - d->qfrc_bias[i] + d->qfrc_applied[i] + actuator;
  }
}

}  // namespace rotorub::plugin
