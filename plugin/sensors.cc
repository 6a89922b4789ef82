#include "plugin/sensors.h"

#include "native_model/dynamics/dynamics.h"
#include "plugin/contact/forces.h"
#include "plugin/contact/verlet.h"
#include "plugin/control.h"
#include "plugin/coordinates.h"
#include "plugin/own/own_space.h"
#include "plugin/own/reach.h"
#include "plugin/shadow.h"
#include "plugin/user_data.h"

namespace rotorub::plugin {
namespace {

void put(mjData* d, int address, double value) {
  if (address >= 0) d->sensordata[address] = value;
}

void put(mjData* d, int address, const Eigen::Vector2d& value) {
  if (address < 0) return;
  d->sensordata[address] = value.x();
  d->sensordata[address + 1] = value.y();
}

ContactPoint point_of(const Config& config, const mjModel* m, mjData* d) {
  if (config.own) return own_contact_point(config, m, d);
  const Coordinates state(config, d);
  const double* v = config.takes_native_steps() ? velocities_of_pass(config, d) : state.v();
  return contact_point(config.model, state.q(), v);
}

double gap_of(const Config& config, const mjData* d) {
  const double clearance = config.model.contact->clearance;
  if (config.own) return clearance - own_position(config, d).norm();
  const Coordinates state(config, d);
  return clearance -
         (rotor_point(config.model, state.q()) - stator_point(config.model, state.q())).norm();
}

// Beside MuJoCo's own rotor what the shadow has come to (shadow.h).
void fill_shadow_sensors(const Config& config, mjData* d) {
  const ShadowConfig& s = *config.shadow;
  const Model& model = s.model;
  if (s.mujoco_rotor >= 0) {
    const Coordinates state(config, d);
    put(d, s.mujoco_rotor, rotor_point(config.model, state.q()));
  }
  const double* entry = d->userdata + s.data;
  const double* q = shadow_state(config, d);
  put(d, s.rotor, rotor_point(model, q));
  put(d, s.stator, stator_point(model, q));
  if (!model.contact) return;
  put(d, s.gap, contact_point(model, q, q + model.nq()).gap);
  put(d, s.normal_force, entry[kShadowNormal]);
  put(d, s.friction_force, entry[kShadowFriction]);
}

}  // namespace

void mark_active(const Config& config, mjData* d, bool acts) {
  put(d, config.sensors.active, acts ? 1.0 : 0.0);
}

void fill_sensors(const Config& config, const mjModel* m, mjData* d, int stage) {
  const SensorAddresses& s = config.sensors;
  if (stage == mjSTAGE_ACC && (s.control_force >= 0 || s.current >= 0)) {
    const ActuatorState actuator = actuator_state(config, m, d);
    put(d, s.control_force, actuator.force);
    put(d, s.current, actuator.current);
  }
  if (stage == mjSTAGE_VEL && config.shadow) fill_shadow_sensors(config, d);
  if (!config.model.contact) return;
  if (stage == mjSTAGE_ACC) {
    const ContactForces forces = contact_forces(config, d);
    put(d, s.normal_force, forces.normal);
    put(d, s.friction_force, forces.friction);
    return;
  }
  if (stage == mjSTAGE_POS && s.gap >= 0) put(d, s.gap, gap_of(config, d));
  if (stage == mjSTAGE_VEL && (s.gap_rate >= 0 || s.slip >= 0)) {
    const ContactPoint point = point_of(config, m, d);
    put(d, s.gap_rate, point.gap_rate);
    put(d, s.slip, point.slip);
  }
}

}  // namespace rotorub::plugin
