#include "plugin/model/contact_sensors.h"

#include <array>

#include "mjcf/names.h"
#include "plugin/model/later_attributes.h"
#include "plugin/model/message.h"
#include "plugin/model/mujoco_versions.h"

namespace rotorub::plugin {
namespace {

namespace names = mjcf_names;

ScaledSensor scaled_sensor(const mjModel* m, const std::string& name) {
  ScaledSensor s;
  s.address = sensor_address(m, name, 1);
  if (s.address < 0) return s;
  s.reference = count(m->nuser_sensor) * mj_name2id(m, mjOBJ_SENSOR, name.c_str());
  if (m->nuser_sensor < 1 || !(m->sensor_user[s.reference] > 0.0)) {
    refuse(message("<user name=\"{}\">", name),
           "user[0] must be the force that is shown as 1; write user=\"200\" for 200 N");
  }
  return s;
}

}  // namespace

int sensor_address(const mjModel* m, const std::string& name, int dim) {
  const int id = mj_name2id(m, mjOBJ_SENSOR, name.c_str());
  if (id < 0 || m->sensor_type[id] != mjSENS_USER) return -1;
  if (m->sensor_dim[id] != dim) {
    refuse(message("<user name=\"{}\">", name), message("needs dim=\"{}\"", dim));
  }
  check_sensor_attributes(m, id);
  return m->sensor_adr[id];
}

std::span<const char* const> contact_sensor_names() {
  static constexpr std::array kAll{names::kActive,
                                   names::kGap,
                                   names::kGapRate,
                                   names::kSlip,
                                   names::kNormalForce,
                                   names::kFrictionForce,
                                   names::kGapScaled,
                                   names::kNormalForceScaled,
                                   names::kFrictionForceScaled};
  return kAll;
}

SensorAddresses contact_sensors(const mjModel* m, const std::string& prefix,
                                const std::string& suffix) {
  const auto named = [&](const char* name) { return prefix + name + suffix; };
  const auto address = [&](const char* name) { return sensor_address(m, named(name), 1); };
  SensorAddresses s;
  s.active = address(names::kActive);
  s.gap = address(names::kGap);
  s.gap_rate = address(names::kGapRate);
  s.slip = address(names::kSlip);
  s.normal_force = address(names::kNormalForce);
  s.friction_force = address(names::kFrictionForce);
  s.gap_scaled = address(names::kGapScaled);
  s.normal_force_scaled = scaled_sensor(m, named(names::kNormalForceScaled));
  s.friction_force_scaled = scaled_sensor(m, named(names::kFrictionForceScaled));
  const auto elsewhere = [&](const char* name, int stage) {
    const int id = mj_name2id(m, mjOBJ_SENSOR, named(name).c_str());
    return id >= 0 && m->sensor_type[id] == mjSENS_USER && m->sensor_needstage[id] != stage;
  };
  s.gap_in_control =
      elsewhere(names::kGap, mjSTAGE_POS) || elsewhere(names::kGapScaled, mjSTAGE_POS);
  s.rates_in_control =
      elsewhere(names::kGapRate, mjSTAGE_VEL) || elsewhere(names::kSlip, mjSTAGE_VEL);
  return s;
}

}  // namespace rotorub::plugin
