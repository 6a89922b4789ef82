#include "plugin/later_attributes.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "native_model/scene/scene.h"
#include "plugin/message.h"
#include "plugin/mujoco_versions.h"

namespace rotorub::plugin {
namespace {

[[maybe_unused]] bool any(const mjtNum* values, int n) {
  return std::any_of(values, values + n, [](mjtNum x) { return x != 0.0; });
}

// MuJoCo's solver alone finds the force, from its own references.
bool is_mujocos_alone(const ContactPair& pair) {
  return pair.law == scene::ContactModel::kCone && pair.friction_reference == 0.0 &&
         !pair.contact.gives();
}

std::string instead() { return "contact model cone (without a friction reference)"; }

template <typename Model>
std::string moving_surface(const Model* m, const ContactPair& pair) {
  if constexpr (requires { m->geom_surfacevel; }) {
    for (const int geom : {pair.rotor_geom, pair.ring_geom}) {
      if (!any(m->geom_surfacevel + 6 * geom, 6)) continue;
      return message(
          "rotorub: <geom name=\"{}\" surfacevel=\"...\">: contact model {} does not support a "
          "surface that moves; accepted: 0, a joint that turns the geom's body, or {}",
          m->names + m->name_geomadr[geom], scene::to_string(pair.law), instead());
    }
  }
  return {};
}

template <typename Model>
std::string adhesion(const Model* m, const ContactPair& pair) {
  if constexpr (requires { m->pair_adhesion; }) {
    if (pair.pair >= 0 && m->pair_adhesion[pair.pair] != 0.0) {
      return message(
          "rotorub: <pair geom1=\"{}\" geom2=\"{}\" adhesion=\"{}\">: contact model {} does "
          "not support adhesion; accepted: 0, or {}",
          m->names + m->name_geomadr[pair.rotor_geom], m->names + m->name_geomadr[pair.ring_geom],
          m->pair_adhesion[pair.pair], scene::to_string(pair.law), instead());
    }
    for (const int geom : {pair.rotor_geom, pair.ring_geom}) {
      if (m->geom_adhesion[geom] == 0.0) continue;
      return message(
          "rotorub: <geom name=\"{}\" adhesion=\"{}\">: contact model {} does not support "
          "adhesion; accepted: 0, or {}",
          m->names + m->name_geomadr[geom], m->geom_adhesion[geom], scene::to_string(pair.law),
          instead());
    }
  }
  return {};
}

template <typename Model>
void check_sensor(const Model* m, int sensor) {
  if constexpr (requires { m->sensor_history; }) {
    const bool delayed = m->sensor_history[2 * sensor] > 0 || m->sensor_delay[sensor] > 0.0 ||
                         m->sensor_interval[2 * sensor] > 0.0;
    if (!delayed) return;
    refuse(message("<user name=\"{}\">", m->names + m->name_sensoradr[sensor]),
           "has nsample, delay or interval, but the plugin writes its value of every pass; "
           "accepted: none of the three");
  }
}

// The parts of a generated model whose motion the plugin computes.
class GeneratedParts {
 public:
  GeneratedParts(const mjModel* m, const Config& config) : m_(m), dofs_(config.dof_address) {}

  bool has_body(int body) const {
    return std::any_of(dofs_.begin(), dofs_.end(),
                       [&](int dof) { return dof >= 0 && m_->dof_bodyid[dof] == body; });
  }
  bool has_joint(int joint) const {
    return std::any_of(dofs_.begin(), dofs_.end(),
                       [&](int dof) { return dof >= 0 && m_->dof_jntid[dof] == joint; });
  }
  bool has_tendon(int tendon) const {
    const int first = m_->tendon_adr[tendon];
    for (int w = first; w < first + m_->tendon_num[tendon]; ++w) {
      if (m_->wrap_type[w] == mjWRAP_JOINT && has_joint(m_->wrap_objid[w])) return true;
    }
    return false;
  }
  bool has_transmission(int actuator) const {
    const int type = m_->actuator_trntype[actuator], id = m_->actuator_trnid[2 * actuator];
    if (type == mjTRN_JOINT || type == mjTRN_JOINTINPARENT) return has_joint(id);
    return type == mjTRN_TENDON && has_tendon(id);
  }

 private:
  const mjModel* m_;
  const std::vector<int>& dofs_;
};

template <typename Model>
void check_gravity(const Model* m, const GeneratedParts& parts) {
  if constexpr (requires { m->body_gravcomp; }) {
    for (int i = 0; i < m->nbody; ++i) {
      if (m->body_gravcomp[i] == 0.0 || !parts.has_body(i)) continue;
      refuse(body_element(m, i),
             message("gravcomp=\"{}\", but the plugin applies the weight of a generated rotor and "
                     "of its ring; accepted: 0, and [gravity] in the scene",
                     m->body_gravcomp[i]));
    }
  }
}

template <typename Model>
void check_joints(const Model* m, const GeneratedParts& parts) {
  for (int i = 0; i < m->njnt; ++i) {
    if (!parts.has_joint(i)) continue;
    if constexpr (requires { m->jnt_actfrclimited; }) {
      if (m->jnt_actfrclimited[i]) {
        refuse(joint_element(m, i),
               "has an actuatorfrcrange, which the plugin's actuators do not know; accepted: "
               "none, and the limit in the scene");
      }
    }
    if constexpr (requires { m->jnt_stiffnesspoly; }) {
      if (any(m->jnt_stiffnesspoly + kPolynomial * i, kPolynomial)) {
        refuse(joint_element(m, i),
               "its stiffness is a polynomial, that of a mode is a number; accepted: one number");
      }
    }
  }
}

template <typename Model>
void check_tendons(const Model* m, const GeneratedParts& parts) {
  for (int i = 0; i < m->ntendon; ++i) {
    const std::string element = message("<fixed name=\"{}\">", m->names + m->name_tendonadr[i]);
    if constexpr (requires { m->tendon_armature; }) {
      if (m->tendon_armature[i] != 0.0 && parts.has_tendon(i)) {
        refuse(element,
               message("armature=\"{}\" couples the modes of a generated rotor; accepted: 0",
                       m->tendon_armature[i]));
      }
    }
    if constexpr (requires { m->tendon_actfrclimited; }) {
      if (m->tendon_actfrclimited[i] && parts.has_tendon(i)) {
        refuse(element,
               "has an actuatorfrcrange, which the plugin's actuators do not know; accepted: "
               "none, and the limit in the scene");
      }
    }
    if constexpr (requires { m->tendon_stiffnesspoly; }) {
      if (any(m->tendon_stiffnesspoly + kPolynomial * i, kPolynomial) && parts.has_tendon(i)) {
        refuse(element, "its stiffness is a polynomial; accepted on a generated rotor: one number");
      }
    }
  }
}

template <typename Model>
std::string actuator_element(const Model* m, int actuator) {
  return message("<actuator name=\"{}\">", m->names + m->name_actuatoradr[actuator]);
}

template <typename Model>
void check_actuators(const Model* m, const GeneratedParts& parts) {
  if constexpr (requires { m->actuator_armature; }) {
    for (int i = 0; i < actuator_count(m); ++i) {
      if (m->actuator_armature[i] == 0.0 || !parts.has_transmission(i)) continue;
      refuse(actuator_element(m, i),
             message("armature=\"{}\" on a generated rotor; accepted: 0, and the armature of the "
                     "joint, which is the mass of its mode",
                     m->actuator_armature[i]));
    }
  }
}

// Without either, the two are MuJoCo's motors for the user's commands.
bool commands_bearing(const Config& config) {
  const AuxiliaryBearing& first = config.model.first();
  return !config.own && (first.controller || first.magnets);
}

template <typename Model>
void check_bearing(const Model* m, const Config& config) {
  for (const int i : config.actuator) {
    if (i < 0) continue;
    if constexpr (requires { m->actuator_history; }) {
      if (m->actuator_history[2 * i] > 0 || m->actuator_delay[i] > 0.0) {
        refuse(actuator_element(m, i),
               "has nsample or delay, which the plugin's control does not know; accepted: "
               "neither, and the delay in the scene");
      }
    }
    if constexpr (requires { m->actuator_actearly; }) {
      if (m->actuator_actearly[i]) {
        refuse(actuator_element(m, i), "actearly=\"true\"; accepted: \"false\"");
      }
    }
  }
}

template <typename Model>
bool is_disabled(const Model* m, int actuator) {
  if constexpr (requires { m->opt.disableactuator; }) {
    const int group = m->actuator_group[actuator];
    return group >= 0 && group <= 30 && (m->opt.disableactuator & (1 << group));
  }
  return false;
}

}  // namespace

std::string refused_surface(const mjModel* m, const ContactPair& pair) {
  if (is_mujocos_alone(pair)) return {};
  const std::string moving = moving_surface(m, pair);
  return moving.empty() ? adhesion(m, pair) : moving;
}

void check_sensor_attributes(const mjModel* m, int sensor) { check_sensor(m, sensor); }

void check_generated_attributes(const mjModel* m, const Config& config) {
  for (const ContactPair& pair : config.pairs) {
    const std::string surface = refused_surface(m, pair);
    if (!surface.empty()) throw ConfigError(surface);
  }
  const GeneratedParts parts(m, config);
  check_gravity(m, parts);
  check_joints(m, parts);
  check_tendons(m, parts);
  check_actuators(m, parts);
  if (commands_bearing(config)) check_bearing(m, config);
}

bool bearing_is_disabled(const mjModel* m, const Config& config) {
  return commands_bearing(config) &&
         std::any_of(std::begin(config.actuator), std::end(config.actuator),
                     [m](int actuator) { return actuator >= 0 && is_disabled(m, actuator); });
}

}  // namespace rotorub::plugin
