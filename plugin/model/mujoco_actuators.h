// Actuators and engine plugins in MuJoCo's versions (mujoco_versions.h).
#pragma once

#include <mujoco/mujoco.h>

#include <cstddef>
#include <span>
#include <string_view>

#include "plugin/model/mujoco_versions.h"

namespace rotorub::plugin {

// --- Actuators: each has one control and one force, except some of 3.11 and later ---

template <typename Model>
int control_address(const Model* m, int actuator) {
  if constexpr (requires { m->actuator_ctrladr; }) return m->actuator_ctrladr[actuator];
  return actuator;
}
template <typename Model>
int force_address(const Model* m, int actuator) {  // the same for lengths
  if constexpr (requires { m->actuator_outadr; }) return m->actuator_outadr[actuator];
  return actuator;
}
template <typename Model>
int actuator_count(const Model* m) {
  if constexpr (requires { m->nactuator; }) {
    return count(m->nactuator);
  } else {
    return count(m->nu);
  }
}
// -1: no activation. In 2.2 the stateful actuators come last, with one activation each.
template <typename Model>
int activation_address(const Model* m, int actuator) {
  if (m->actuator_dyntype[actuator] == mjDYN_NONE) return -1;
  if constexpr (requires { m->actuator_actadr; }) {
    return m->actuator_actadr[actuator];
  } else {
    return actuator - (count(m->nu) - count(m->na));
  }
}

// Actuators of engine plugins.
template <typename Model>
bool is_engine_actuator(const Model* m, int actuator) {
  if constexpr (requires { m->actuator_plugin; }) return m->actuator_plugin[actuator] >= 0;
  return false;
}
template <typename Model>
bool has_engine_actuators(const Model* m) {
  if constexpr (requires { m->actuator_plugin; }) {
    for (int i = 0; m->nplugin > 0 && i < actuator_count(m); ++i) {
      if (is_engine_actuator(m, i)) return true;
    }
  }
  return false;
}
// The instances of engine plugins: their plugin numbers, all their configuration texts, and their
// states.
template <typename Model>
std::span<const int> plugin_slots(const Model* m) {
  if constexpr (requires { m->npluginattr; }) {
    return {m->plugin, static_cast<std::size_t>(m->nplugin)};
  } else {
    return {};
  }
}
template <typename Model>
std::string_view plugin_attributes(const Model* m) {
  if constexpr (requires { m->npluginattr; }) {
    return {m->plugin_attr, static_cast<std::size_t>(m->npluginattr)};
  } else {
    return {};
  }
}
template <typename Model, typename Data>
std::span<mjtNum> plugin_state(const Model* m, Data* d) {
  if constexpr (requires { m->npluginstate; }) {
    return {d->plugin_state, static_cast<std::size_t>(m->npluginstate)};
  } else {
    return {};
  }
}

// Adds the passive forces of engine plugins to qfrc_passive, as mj_passive does after mjcb_passive.
inline void add_plugin_forces(const mjModel* m, mjData* d) {
#if mjVERSION_HEADER >= 235
  for (int i = 0; i < count(m->nplugin); ++i) {
    const mjpPlugin* plugin = mjp_getPluginAtSlot(m->plugin[i]);
    if (plugin && (plugin->capabilityflags & mjPLUGIN_PASSIVE) && plugin->compute)
      plugin->compute(m, d, i, mjPLUGIN_PASSIVE);
  }
#else
  static_cast<void>(m), static_cast<void>(d);
#endif
}

}  // namespace rotorub::plugin
