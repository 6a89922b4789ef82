#include "plugin/callbacks.h"

#include <mujoco/mujoco.h>

#include "plugin/config_cache.h"
#include "plugin/contact/annular.h"
#include "plugin/contact/cone.h"
#include "plugin/contact/coulomb.h"
#include "plugin/contact/segment_coulomb.h"
#include "plugin/contact/segment_rigid.h"
#include "plugin/contact/verlet.h"
#include "plugin/control.h"
#include "plugin/coordinates.h"
#include "plugin/magnets.h"
#include "plugin/own/own_contact.h"
#include "plugin/passive.h"
#include "plugin/segment_loads.h"
#include "plugin/sensors.h"
#include "plugin/shadow.h"
#include "plugin/user_data.h"

namespace rotorub::plugin {
namespace {

// One place in MuJoCo's tables. Written while no other thread steps, read by all.
template <typename Function>
struct Hook {
  Function previous = nullptr;
  bool buried = false;  // another library stands in front of us and calls us

  void put_in_front(Function& place, Function ours) {
    if (buried || place == ours) return;
    previous = place;
    place = ours;
  }
  void give_back(Function& place, Function ours) {
    buried = place != ours;
    if (!buried) place = previous;
  }
};

bool active = false;
Hook<mjfGeneric> control_hook, passive_hook;
Hook<mjfSensor> sensor_hook;
Hook<mjfAct> gain_hook, bias_hook, rate_hook;
// By the types of the two geoms, from sphere to box: those of a scene are a sphere and a capsule,
// those of a user's own model may be any.
constexpr int kFirstShape = mjGEOM_SPHERE, kShapes = mjGEOM_BOX - mjGEOM_SPHERE + 1;
Hook<mjfCollision> collision_hooks[kShapes][kShapes];

void passive(const mjModel* m, mjData* d) {
  if (passive_hook.previous) passive_hook.previous(m, d);
  if (!active) return;
  const Config* config = find_config_checked(m, d);
  if (!config) return;
  if (config->shadow) advance_shadow(*config, m, d);
  if (config->own) {
    d->userdata[kPassiveFresh] = 1.0;
    return;
  }
  if (config->segments) {
    add_segment_loads(*config, d);
  } else if (!config->takes_native_steps()) {
    add_passive_force(*config, m, d, Coordinates(*config, d));
  }
  fill_sensors(*config, m, d, mjSTAGE_VEL);
  d->userdata[kPassiveFresh] = 1.0;
}

// MuJoCo may run this stage again without the one before (mj_forwardSkip): then what it added to
// the velocity stage's results is taken out by computing those anew.
void refresh_velocity_stage(const mjModel* m, mjData* d) {
  if (d->userdata[kPassiveFresh] == 0.0) {
    mj_passive(m, d);
    mj_referenceConstraint(m, d);
  }
  d->userdata[kPassiveFresh] = 0.0;
}

void control(const mjModel* m, mjData* d) {
  if (control_hook.previous) control_hook.previous(m, d);
  if (!active) return;
  const Config* config = find_config(m, d);
  if (!config) return;
  if (config->own) {
    refresh_velocity_stage(m, d);
    apply_own_contact(*config, m, d);
    if (config->contact != scene::ContactModel::kCone) fill_sensors(*config, m, d, mjSTAGE_ACC);
    return;
  }
  const Coordinates state(*config, d);
  if (config->takes_native_steps()) {
    refresh_velocity_stage(m, d);
    apply_verlet(*config, m, d, state);
    fill_sensors(*config, m, d, mjSTAGE_VEL);
    fill_sensors(*config, m, d, mjSTAGE_ACC);
    return;
  }
  write_command(*config, m, d, state);
  if (!config->model.contact) return;
  refresh_velocity_stage(m, d);
  if (config->general) {
    apply_own_contact(*config, m, d);
    if (config->contact == scene::ContactModel::kRigid) fill_sensors(*config, m, d, mjSTAGE_ACC);
    return;
  }
  if (config->contact == scene::ContactModel::kRigid) {
    apply_segment_rigid(*config, m, d, state);
    fill_sensors(*config, m, d, mjSTAGE_ACC);
    return;
  }
  d->userdata[kFrictionForce] = 0.0;
  const mjContact* contact = find_contact(*config, d);
  if (!contact) {
    d->userdata[kMode] = 0.0;
    return;
  }
  if (config->segments) {
    // `cone` needs nothing: the segments spin.
    if (config->contact == scene::ContactModel::kCoulomb) {
      apply_segment_coulomb(*config, m, d, *contact, state);
    }
  } else if (config->contact == scene::ContactModel::kCoulomb) {
    apply_coulomb(*config, m, d, *contact, state);
  } else {
    apply_cone(*config, d, *contact);
  }
}

void sensor(const mjModel* m, mjData* d, int stage) {
  if (sensor_hook.previous) sensor_hook.previous(m, d, stage);
  if (!active) return;
  if (const Config* config = find_config(m, d)) fill_sensors(*config, m, d, stage);
}

// The config whose magnet this actuator is, or null.
const Config* config_of_magnet(const mjModel* m, const mjData* d, int actuator) {
  const Config* config = active ? find_config(m, d) : nullptr;
  return config && is_magnet(*config, actuator) ? config : nullptr;
}

// Others' actuators have what MuJoCo gives without a callback, or what was installed before us.
mjtNum gain(const mjModel* m, const mjData* d, int id) {
  if (const Config* config = config_of_magnet(m, d, id)) return magnet_gain(*config, m, d, id);
  return gain_hook.previous ? gain_hook.previous(m, d, id) : 1.0;
}

mjtNum bias(const mjModel* m, const mjData* d, int id) {
  if (const Config* config = config_of_magnet(m, d, id)) return magnet_bias(*config, d, id);
  return bias_hook.previous ? bias_hook.previous(m, d, id) : 0.0;
}

mjtNum activation_rate(const mjModel* m, const mjData* d, int id) {
  if (const Config* config = config_of_magnet(m, d, id)) return coil_rate(*config, m, d, id);
  return rate_hook.previous ? rate_hook.previous(m, d, id) : 0.0;
}

Hook<mjfCollision>& collision_hook(const mjModel* m, int g1, int g2) {
  return collision_hooks[m->geom_type[g1] - kFirstShape][m->geom_type[g2] - kFirstShape];
}

// The pair's, where the model has one; it is not among the arguments of every version.
double margin_of(const mjModel* m, const Config& config) {
  return config.pair >= 0 ? m->pair_margin[config.pair] : 0.0;
}

// The arguments of mjfCollision have changed between MuJoCo's versions; whatever they are, they
// are taken from its type.
template <typename Function>
struct Collision;

template <typename Model, typename Data, typename Contact, typename... Rest>
struct Collision<int (*)(Model, Data, Contact, int, int, Rest...)> {
  static int collide(Model m, Data d, Contact con, int g1, int g2, Rest... rest) {
    const Config* config = active ? find_config(m, d) : nullptr;
    const bool ours = config && ((g1 == config->rotor_geom && g2 == config->ring_geom) ||
                                 (g1 == config->ring_geom && g2 == config->rotor_geom));
    if (!ours) {
      const auto previous = collision_hook(m, g1, g2).previous;
      return previous ? previous(m, d, con, g1, g2, rest...) : 0;
    }
    if (config->own) return collide_own(*config, d, con, g1, margin_of(m, *config));
    return collide_annular(*config, d, con, g1, margin_of(m, *config));
  }
};

constexpr mjfCollision kCollide = &Collision<mjfCollision>::collide;

// MuJoCo's table is of ordered types.
template <typename Action>
void for_each_collision(Action action) {
  for (int i = 0; i < kShapes; ++i) {
    for (int j = i; j < kShapes; ++j) {
      action(collision_hooks[i][j], mjCOLLISIONFUNC[kFirstShape + i][kFirstShape + j]);
    }
  }
}

}  // namespace

void install_callbacks() {
  passive_hook.put_in_front(mjcb_passive, passive);
  control_hook.put_in_front(mjcb_control, control);
  sensor_hook.put_in_front(mjcb_sensor, sensor);
  gain_hook.put_in_front(mjcb_act_gain, gain);
  bias_hook.put_in_front(mjcb_act_bias, bias);
  rate_hook.put_in_front(mjcb_act_dyn, activation_rate);
  for_each_collision([](auto& hook, mjfCollision& place) { hook.put_in_front(place, kCollide); });
  active = true;
}

void restore_callbacks() {
  active = false;
  passive_hook.give_back(mjcb_passive, passive);
  control_hook.give_back(mjcb_control, control);
  sensor_hook.give_back(mjcb_sensor, sensor);
  gain_hook.give_back(mjcb_act_gain, gain);
  bias_hook.give_back(mjcb_act_bias, bias);
  rate_hook.give_back(mjcb_act_dyn, activation_rate);
  for_each_collision([](auto& hook, mjfCollision& place) { hook.give_back(place, kCollide); });
}

}  // namespace rotorub::plugin
