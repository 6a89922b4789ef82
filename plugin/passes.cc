#include "plugin/passes.h"

#include <algorithm>
#include <cmath>

#include "native_model/scene/mujoco.h"
#include "plugin/callbacks.h"
#include "plugin/config_cache.h"
#include "plugin/contact/contact_memory.h"
#include "plugin/contact/pairs.h"
#include "plugin/contact/verlet.h"
#include "plugin/load_cells.h"
#include "plugin/model/actuators.h"
#include "plugin/model/control.h"
#include "plugin/model/generated_rotor.h"
#include "plugin/model/mujoco_actuators.h"
#include "plugin/model/mujoco_versions.h"
#include "plugin/model/options.h"
#include "plugin/model/segments.h"
#include "plugin/model/user_data.h"
#include "plugin/own/load_warnings.h"
#include "plugin/sensors.h"
#include "plugin/shadow.h"
#include "plugin/solver_watch.h"
#include "plugin/written_state.h"

namespace rotorub::plugin {
namespace {

// Keeps changes of the constraints' references that are made before MuJoCo computes the references.
// After mjcb_passive MuJoCo computes
//   aref = -B vel - K I (pos - margin).
// The constructor computes the same. keep() then changes the rows' `pos` so that MuJoCo's result
// equals the changed references. It may be called again in the same pass.
class KeptReferences {
 public:
  KeptReferences(const mjModel* m, mjData* d)
      : d_(d), room_(d), aref_(room_.numbers(d->nefc)), velocity_(room_.numbers(d->nefc)) {
    for (int i = 0; i < d->nefc; ++i) {
      const mjtNum* kbip = d->efc_KBIP + 4 * i;
      if (kbip[0] == kOurs && kbip[2] == kOurs) d->efc_pos[i] = d->efc_margin[i];
    }
    mj_referenceConstraint(m, d);
    std::copy_n(d->efc_aref, d->nefc, aref_);
    std::copy_n(d->efc_vel, d->nefc, velocity_);
  }
  void keep() {
    for (int i = 0; i < d_->nefc; ++i) {
      if (d_->efc_aref[i] == aref_[i]) continue;
      mjtNum* kbip = d_->efc_KBIP + 4 * i;
      if (kbip[0] * kbip[2] == 0.0) kbip[0] = kbip[2] = kOurs;
      const double rest = d_->efc_aref[i] + kbip[1] * velocity_[i];
      d_->efc_pos[i] = d_->efc_margin[i] - rest / (kbip[0] * kbip[2]);
    }
  }

 private:
  // Stiffness and impedance that keep() sets in a row without them. They mark rows whose reference
  // is stored in `pos`.
  static constexpr double kOurs = 1.0;

  mjData* d_;
  StackFrame room_;
  mjtNum *aref_, *velocity_;  // as MuJoCo computes them
};

// Takes back the slots that others have overwritten. If another function has collided the pair,
// MuJoCo's soft contact is made again, so that even this pass has its contact.
bool keep_slots(const Config& config, const mjModel* m, mjData* d) {
  keep_callbacks();
  if (!config.has_contact() || !collision_was_lost(config, m)) return false;
  if (!config.has_soft() || !contact_enabled(m)) return false;
  mj_fwdPosition(m, d);
  return true;
}

// The mjData whose model was compared since the last mjcb_passive of this thread.
thread_local constinit const mjData* compared = nullptr;

// The value of ModelEntries::passive_fresh after mjcb_passive.
double fresh_mark(const mjData* d) { return 1.0 + std::abs(d->time); }

mjtNum& fresh_entry(const Config& config, mjData* d) {
  return model_entries(config, d).passive_fresh;
}

// If the mark belongs to another time, the pass at that time had no mjcb_control after its
// mjcb_passive.
void notice_missed_control(const Config& config, mjData* d) {
  const double mark = fresh_entry(config, d);
  if (mark <= 0.0 || mark == fresh_mark(d) || !distrust_control()) return;
  warn(
      "rotorub: your mjcb_control called the plugin's mjcb_control before, but not in the last "
      "step, so that step had no contact; from now on the plugin's runs first");
}

void add_loads(const Config& config, const mjModel* m, mjData* d) {
  if (config.own) return;
  try {
    if (config.segments) {
      add_segment_loads(config, m, d);
    } else {
      const Coordinates state(config, d);
      place_further_contacts(config, m, d, state);
      if (!config.takes_native_steps()) add_passive_force(config, m, d, state);
    }
  } catch (const ControllerError& error) {
    controller_failed(d, error.what());
  }
  fill_sensors(config, m, d, mjSTAGE_VEL);
}

// MuJoCo may run the acceleration stage again without the velocity stage (mj_forwardSkip), or may
// have run the velocity stage without the plugin. Then its results are computed again, which
// removes what was added to them in the meantime.
void refresh_velocity_stage(const Config& config, const mjModel* m, mjData* d) {
  mjtNum& fresh = fresh_entry(config, d);
  if (fresh != fresh_mark(d)) {
    keep_callbacks();
    mj_passive(m, d);
    const bool plugin_not_called = fresh != fresh_mark(d) && !passive_disabled(m);
    if (plugin_not_called && distrust_passive()) mj_passive(m, d);
    mj_referenceConstraint(m, d);
  }
  fresh = 0.0;
}

// Writes the command of the scene's controller and applies the contacts of this pass.
void apply_command_and_contacts(const Config& config, const mjModel* m, mjData* d,
                                PassMotion& motion) {
  if (config.takes_native_steps()) {
    try {
      apply_verlet(config, m, d, Coordinates(config, d));
    } catch (const ControllerError& error) {
      controller_failed(d, error.what());
    }
    fill_sensors(config, m, d, mjSTAGE_VEL);
  } else {
    if (!config.own) write_command(config, m, d);
    apply_contacts(config, m, d, motion);
  }
  if (config.own) {
    fill_sensors_in_control(config, m, d, motion);
  } else if (config.has_rigid()) {
    fill_sensors(config, m, d, mjSTAGE_ACC);
  }
}

bool has_escaped(const Config& config, mjData* d) {
  return std::any_of(config.pairs.begin(), config.pairs.end(), [d](const ContactPair& pair) {
    return pair.contact_model == scene::ContactModel::kRigid &&
           ContactStatus(contact_entries(pair, d).status).has(kIsOutside);
  });
}

void run_control_stage(const Config& config, const mjModel* m, mjData* d) {
  if (const char* why = refused_integrator(config, m)) {
    mark_active(config, d, false);
    raise_error(why);
    return;
  }
  watch_solver(config, m, d);
  tell_load_warnings(config, d);
  PassMotion motion(config, m, d);
  forget_written_contacts(config, m, d, motion);
  apply_command_and_contacts(config, m, d, motion);
  note_solved_contacts(config, m, d);
  seal_block(config, d);
  mark_active(config, d, (!config.has_contact() || contact_enabled(m)) && !has_escaped(config, d));
}

// Passive forces of engine plugins, which MuJoCo adds after mjcb_passive. They are part of
// qfrc_passive while this object lives, and are then removed for MuJoCo to add them.
class PluginForces {
 public:
  PluginForces(const mjModel* m, mjData* d)
      : d_(d), nv_(count(m->nv)), room_(d), force_(room_.numbers(nv_)) {
    std::copy_n(d->qfrc_passive, nv_, force_);
    add_plugin_forces(m, d);
    for (int i = 0; i < nv_; ++i) force_[i] = d->qfrc_passive[i] - force_[i];
  }
  ~PluginForces() {
    for (int i = 0; i < nv_; ++i) d_->qfrc_passive[i] -= force_[i];
  }
  PluginForces(const PluginForces&) = delete;
  PluginForces& operator=(const PluginForces&) = delete;

 private:
  mjData* d_;
  int nv_;
  StackFrame room_;
  mjtNum* force_;
};

// If MuJoCo does not call mjcb_control, mjcb_passive is the last callback. Therefore this function
// first computes what MuJoCo's velocity stage would compute after it.
void run_control_stage_early(const Config& config, const mjModel* m, mjData* d) {
  begin_actuators(d);
  const PluginForces others(m, d);
  mj_rne(m, d, 0, d->qfrc_bias);
  KeptReferences references(m, d);
  run_control_stage(config, m, d);
  references.keep();
}

}  // namespace

void passive_pass(const mjModel* m, mjData* d) {
  // The collision function of this pass may already have compared the model.
  const Config* config = compared == d ? find_config(m, d) : find_config_checked(m, d);
  compared = nullptr;
  if (!config) return;
  keep_slots(*config, m, d);
  compare_actuators(m, d);
  notice_missed_control(*config, d);
  mark_active(*config, d, false);
  if (const char* why = refused_options(*config, m)) {
    raise_error(why);
    return;
  }
  fresh_entry(*config, d) = fresh_mark(d);
  if (config->shadow) advance_shadow(*config, m, d);
  add_loads(*config, m, d);
  if (control_skipped(m)) run_control_stage_early(*config, m, d);
}

void control_pass(const mjModel* m, mjData* d) {
  const Config* config = find_config(m, d);
  if (!config || control_skipped(m) || refused_options(*config, m)) return;
  if (!block_is_ours(*config, d)) {
    refuse_clash(*config, m);
    return;
  }
  if (keep_slots(*config, m, d)) fresh_entry(*config, d) = 0.0;
  refresh_velocity_stage(*config, m, d);
  run_control_stage(*config, m, d);
}

void sensor_pass(const mjModel* m, mjData* d, int stage) {
  const Config* config = find_config(m, d);
  if (!config) return;
  if (stage == mjSTAGE_POS) keep_callbacks();
  fill_sensors(*config, m, d, stage);
  if (stage == mjSTAGE_ACC && config->cells_in_callback) fill_load_cells(*config, m, d);
  if (stage == mjSTAGE_ACC) compare_actuators(m, d);
  const mjtStage known = control_skipped(m) ? mjSTAGE_VEL : mjSTAGE_ACC;
  if (stage >= known) refill_sensors(*config, m, d);
}

bool collide_pair(const mjModel* m, const mjData* d, CollisionContact* con, int g1, int g2,
                  int& count) {
  // This is the first function of a pass that needs the numbers, so it updates them.
  const Config* config = find_config_checked(m, d);
  if (!config) return false;
  compared = d;
  for (const ContactPair& pair : config->pairs) {
    if (!are_geoms(g1, g2, pair.rotor_geom, pair.ring_geom)) continue;
    keep_callbacks();
    if (const char* why = refused_silence(m)) raise_error(why);
    // The <pair>'s margin, if the model has the <pair>. The margin is not among the arguments in
    // every version.
    const double margin = pair.pair >= 0 ? detected_below(m, pair.pair) : 0.0;
    count = collide_exactly(pair, d, con, g1, margin);
    // A contact that only the plugin solves is kept from MuJoCo's solver even if the pair's gap
    // does not do so.
    const bool kept_out = pair.contact_model == scene::ContactModel::kRigid || pair.further;
    if (kept_out && count > 0 && pair.pair >= 0) {
      con->dist = std::max<mjtNum>(con->dist, solved_below(m, pair.pair));
    }
    return true;
  }
  return false;
}

bool magnet_answers(ActuatorQuestion asked, const mjModel* m, const mjData* d, int id,
                    mjtNum& value) {
  const Config* config = find_config(m, d);
  if (!config || !is_magnet(*config, id)) return false;
  value = magnet_answer(asked, *config, m, d, id);
  return true;
}

}  // namespace rotorub::plugin
