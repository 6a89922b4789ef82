#include "plugin/model/later_attributes.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <vector>

#include "native_model/scene/mujoco.h"
#include "plugin/model/message.h"
#include "plugin/model/mujoco_actuators.h"
#include "plugin/model/mujoco_versions.h"

namespace rotorub::plugin {
namespace {

[[maybe_unused]] bool any(const mjtNum* values, int n) {
  return std::any_of(values, values + n, [](mjtNum x) { return x != 0.0; });
}

// All messages have one form: the element, the attribute and the release that introduced it, what
// is wrong with it here, and what to do.
struct Attribute {
  const char* name;
  const char* since;  // release of MuJoCo
};

constexpr Attribute kStiffnessPolynomial{"stiffness with several numbers", "3.7"};

[[noreturn]] void refuse_attribute(const std::string& element, const Attribute& attribute,
                                   const std::string& wrong, const std::string& remedy) {
  throw ConfigError(message("rotorub: {}: the attribute {}, new in MuJoCo {}, {}; {}", element,
                            attribute.name, attribute.since, wrong, remedy));
}

// True if MuJoCo's solver alone finds the force, from its own references.
bool is_mujocos_alone(const ContactPair& pair) {
  return pair.contact_model == scene::ContactModel::kCone && pair.friction_reference == 0.0 &&
         !pair.contact.is_compliant();
}

std::string unsupported_by(scene::ContactModel law) {
  return message("is not supported by contact model {}", scene::to_string(law));
}
constexpr const char* kOrCone = "or use contact model cone without a friction reference";

template <typename Model>
void check_motion(const Model* m, const ContactPair& pair) {
  if constexpr (requires { m->geom_surfacevel; }) {
    for (const int geom : {pair.rotor_geom, pair.ring_geom}) {
      if (!any(m->geom_surfacevel + 6 * geom, 6)) continue;
      refuse_attribute(
          message("<geom name=\"{}\">", m->names + m->name_geomadr[geom]), {"surfacevel", "3.11"},
          unsupported_by(pair.contact_model),
          message("remove it, turn the body of the geom with a joint instead, {}", kOrCone));
    }
  }
}

// A geom's own adhesion does not act in the plugin's contacts: they all belong to a <pair>, and
// MuJoCo then uses only the attribute of the <pair>.
template <typename Model>
void check_adhesion(const Model* m, int pair, int geom1, int geom2, scene::ContactModel law) {
  if constexpr (requires { m->pair_adhesion; }) {
    if (pair < 0 || m->pair_adhesion[pair] == 0.0) return;
    refuse_attribute(message("<pair geom1=\"{}\" geom2=\"{}\">", m->names + m->name_geomadr[geom1],
                             m->names + m->name_geomadr[geom2]),
                     {"adhesion", "3.11"}, unsupported_by(law), message("remove it, {}", kOrCone));
  }
}

template <typename Model>
void check_sensor(const Model* m, int sensor) {
  if constexpr (requires { m->sensor_history; }) {
    const auto check = [m, sensor](bool given, const char* attribute) {
      if (!given) return;
      refuse_attribute(message("<user name=\"{}\">", m->names + m->name_sensoradr[sensor]),
                       {attribute, "3.5"},
                       "is not supported for a sensor whose value the plugin writes", "remove it");
    };
    check(m->sensor_delay[sensor] > 0.0, "delay");
    check(m->sensor_interval[2 * sensor] > 0.0, "interval");
    check(m->sensor_history[2 * sensor] > 0, "nsample");
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

constexpr const char* kOnGenerated = "is not supported on a generated rotor or its ring";
constexpr const char* kLimitInScene = "remove it, and limit the actuators in the scene instead";
constexpr const char* kNoArmature =
    "remove it, and set the armature of the joints instead, which are the masses of their modes";
constexpr const char* kOneNumber = "give one number";

template <typename Model>
void check_gravity(const Model* m, const GeneratedParts& parts) {
  if constexpr (requires { m->body_gravcomp; }) {
    for (int i = 0; i < m->nbody; ++i) {
      if (m->body_gravcomp[i] == 0.0 || !parts.has_body(i)) continue;
      refuse_attribute(body_element(m, i), {"gravcomp", "2.3.1"},
                       message("{}, whose weight the plugin applies", kOnGenerated),
                       "remove it, and set [gravity] in the scene instead");
    }
  }
}

template <typename Model>
void check_joints(const Model* m, const GeneratedParts& parts) {
  for (int i = 0; i < m->njnt; ++i) {
    const auto check = [&](bool given, const Attribute& attribute, const char* remedy) {
      if (given && parts.has_joint(i))
        refuse_attribute(joint_element(m, i), attribute, kOnGenerated, remedy);
    };
    if constexpr (requires { m->jnt_actfrclimited; })
      check(m->jnt_actfrclimited[i], {"actuatorfrcrange", "2.3.7"}, kLimitInScene);
    if constexpr (requires { m->jnt_stiffnesspoly; })
      check(any(m->jnt_stiffnesspoly + kPolynomial * i, kPolynomial), kStiffnessPolynomial,
            kOneNumber);
  }
}

template <typename Model>
void check_tendons(const Model* m, const GeneratedParts& parts) {
  for (int i = 0; i < m->ntendon; ++i) {
    const auto check = [&](bool given, const Attribute& attribute, const char* remedy) {
      if (!given || !parts.has_tendon(i)) return;
      refuse_attribute(message("<fixed name=\"{}\">", m->names + m->name_tendonadr[i]), attribute,
                       kOnGenerated, remedy);
    };
    if constexpr (requires { m->tendon_armature; })
      check(m->tendon_armature[i] != 0.0, {"armature", "3.3.1"}, kNoArmature);
    if constexpr (requires { m->tendon_actfrclimited; })
      check(m->tendon_actfrclimited[i], {"actuatorfrcrange", "3.3.1"}, kLimitInScene);
    if constexpr (requires { m->tendon_stiffnesspoly; })
      check(any(m->tendon_stiffnesspoly + kPolynomial * i, kPolynomial), kStiffnessPolynomial,
            kOneNumber);
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
      refuse_attribute(actuator_element(m, i), {"armature", "3.7"}, kOnGenerated, kNoArmature);
    }
  }
}

// Without controller and magnets, the two actuators are MuJoCo's motors for the user's commands.
bool commands_bearing(const Config& config) {
  const AuxiliaryBearing& first = config.model.first();
  return !config.own && (first.controller || first.magnets);
}

template <typename Model>
void check_bearing(const Model* m, const Config& config) {
  const auto check = [m](int actuator, bool given, const Attribute& attribute, const char* remedy) {
    if (!given) return;
    refuse_attribute(
        actuator_element(m, actuator), attribute,
        "is not supported on an actuator of the bearing, whose force the plugin computes", remedy);
  };
  for (const int i : config.actuator) {
    if (i < 0) continue;
    if constexpr (requires { m->actuator_history; }) {
      constexpr const char* kDelayInScene = "remove it, and set the delay in the scene instead";
      check(i, m->actuator_delay[i] > 0.0, {"delay", "3.5"}, kDelayInScene);
      check(i, m->actuator_history[2 * i] > 0, {"nsample", "3.5"}, kDelayInScene);
    }
    if constexpr (requires { m->actuator_actearly; }) {
      check(i, m->actuator_actearly[i], {"actearly", "3.0"}, "remove it");
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

void check_surface(const mjModel* m, const ContactPair& pair) {
  if (is_mujocos_alone(pair)) return;
  check_motion(m, pair);
  check_adhesion(m, pair.pair, pair.rotor_geom, pair.ring_geom, pair.contact_model);
}

void check_corrected_pair(const mjModel* m, int pair) {
  check_adhesion(m, pair, m->pair_geom1[pair], m->pair_geom2[pair],
                 scene::ContactModel::kConeCoulomb);
}

void check_sensor_attributes(const mjModel* m, int sensor) { check_sensor(m, sensor); }

void check_generated_attributes(const mjModel* m, const Config& config) {
  for (const ContactPair& pair : config.pairs) check_surface(m, pair);
  const GeneratedParts parts(m, config);
  check_gravity(m, parts);
  check_joints(m, parts);
  check_tendons(m, parts);
  check_actuators(m, parts);
  if (commands_bearing(config)) check_bearing(m, config);
}

const char* refused_attributes(const Config& config, const mjModel* m) {
  static thread_local char text[500];
  try {
    if (config.own) {
      for (const ContactPair& pair : config.pairs) check_surface(m, pair);
      for (const int pair : config.corrected_pairs) check_corrected_pair(m, pair);
    } else {
      check_generated_attributes(m, config);
    }
  } catch (const ConfigError& error) {
    std::snprintf(text, sizeof text, "%s", error.what());
    return text;
  }
  return nullptr;
}

bool bearing_is_disabled(const mjModel* m, const Config& config) {
  return commands_bearing(config) &&
         std::any_of(std::begin(config.actuator), std::end(config.actuator),
                     [m](int actuator) { return actuator >= 0 && is_disabled(m, actuator); });
}

}  // namespace rotorub::plugin
