#include "plugin/sensors.h"

#include "native_model/model/dynamics.h"
#include "native_model/scene/mujoco.h"
#include "plugin/contact/contact_memory.h"
#include "plugin/contact/relative_motion.h"
#include "plugin/contact/verlet.h"
#include "plugin/model/control.h"
#include "plugin/model/generated_rotor.h"
#include "plugin/model/user_data.h"
#include "plugin/shadow.h"

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

void put(const mjModel* m, mjData* d, const ScaledSensor& sensor, double value) {
  if (sensor.address >= 0) d->sensordata[sensor.address] = value / m->sensor_user[sensor.reference];
}

void put_active(const Config& config, mjData* d) {
  const double value = model_entries(config, d).passive_fresh == kActed ? 1.0 : 0.0;
  put(d, config.active, value);
  for (const ContactPair& pair : config.pairs) put(d, pair.sensors.active, value);
}

// True for the contacts of the modal chain and for the first contact of segments. They use the
// native coordinates, in which the loads are computed; the others use the places of the geoms.
bool in_native_coordinates(const Config& config, const ContactPair& pair) {
  return !config.own && (pair.bearing == 0 || pair.further);
}

void fill_gap(const Config& config, const ContactPair& pair, PairMotion& motion, mjData* d) {
  const SensorAddresses& s = pair.sensors;
  if (s.gap < 0 && s.gap_scaled < 0) return;
  const double clearance = pair.contact.clearance;
  const double delta =
      in_native_coordinates(config, pair)
          ? separation(config.model, Coordinates(config, d).q(), pair.bearing).norm()
          : motion.place().d.norm();
  put(d, s.gap, clearance - delta);
  put(d, s.gap_scaled, (clearance - delta) / clearance);
}

ContactPoint point_of(const Config& config, const ContactPair& pair, PairMotion& motion,
                      const mjData* d) {
  if (!in_native_coordinates(config, pair)) return motion.point();
  const Coordinates state(config, d);
  const double* v = config.takes_native_steps() ? velocities_of_pass(config, d) : state.v();
  return contact_point(config.model, state.q(), v, pair.bearing);
}

void fill_rates(const Config& config, const ContactPair& pair, PairMotion& motion, mjData* d) {
  const SensorAddresses& s = pair.sensors;
  if (s.gap_rate < 0 && s.slip < 0) return;
  const ContactPoint point = point_of(config, pair, motion, d);
  put(d, s.gap_rate, point.gap_rate);
  put(d, s.slip, point.slip);
}

void fill_forces(const ContactPair& pair, const mjModel* m, mjData* d) {
  const SensorAddresses& s = pair.sensors;
  const ContactForces forces = contact_forces(pair, m, d);
  put(d, s.normal_force, forces.normal);
  put(d, s.friction_force, forces.friction);
  put(m, d, s.normal_force_scaled, forces.normal);
  put(m, d, s.friction_force_scaled, forces.friction);
}

// Fills the sensors of the shadow (shadow.h), and the sensor of MuJoCo's own rotor.
void fill_shadow_sensors(const Config& config, mjData* d) {
  const ShadowConfig& s = *config.shadow;
  const Model& model = s.model;
  if (s.mujoco_rotor >= 0) {
    const Coordinates state(config, d);
    put(d, s.mujoco_rotor, rotor_point(config.model, state.q()));
  }
  const ShadowEntries& entry = entries<ShadowEntries>(d, s.userdata);
  const double* q = shadow_state(config, d);
  put(d, s.rotor, rotor_point(model, q));
  put(d, s.stator, ring_centre(model, q));
  if (!model.has_contact()) return;
  put(d, s.gap, contact_point(model, q, q + model.nq()).gap);
  put(d, s.normal_force, entry.normal);
  put(d, s.friction_force, entry.friction);
}

}  // namespace

void mark_active(const Config& config, mjData* d, bool acts) {
  model_entries(config, d).passive_fresh = acts ? kActed : kNotActed;
  put_active(config, d);
}

void fill_sensors_in_control(const Config& config, const mjModel* m, mjData* d,
                             PassMotion& motion) {
  for (const ContactPair& pair : config.pairs) {
    if (pair.sensors.gap_in_control) fill_gap(config, pair, motion.of(pair), d);
    if (pair.sensors.rates_in_control) fill_rates(config, pair, motion.of(pair), d);
    if (config.own && !scene::is_cone(pair.contact_model)) fill_forces(pair, m, d);
  }
}

void fill_sensors(const Config& config, const mjModel* m, mjData* d, int stage) {
  if (stage == mjSTAGE_ACC && (config.control_force >= 0 || config.current >= 0)) {
    const ActuatorState actuator = actuator_state(config, m, d);
    put(d, config.control_force, actuator.force);
    put(d, config.current, actuator.current);
  }
  if (stage == mjSTAGE_VEL && config.shadow) fill_shadow_sensors(config, d);
  for (const ContactPair& pair : config.pairs) {
    PairMotion motion(pair, m, d);
    if (stage == mjSTAGE_POS) fill_gap(config, pair, motion, d);
    if (stage == mjSTAGE_VEL) fill_rates(config, pair, motion, d);
    if (stage == mjSTAGE_ACC) fill_forces(pair, m, d);
  }
}

void refill_sensors(const Config& config, const mjModel* m, mjData* d) {
  if (mjVERSION_HEADER < 300) return;
  put_active(config, d);
  PassMotion motion(config, m, d);
  fill_sensors_in_control(config, m, d, motion);
  if (config.own) return;
  if (config.shadow) fill_sensors(config, m, d, mjSTAGE_VEL);
  if (!config.has_soft()) fill_sensors(config, m, d, mjSTAGE_ACC);
}

}  // namespace rotorub::plugin
