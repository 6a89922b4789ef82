#include "plugin/config.h"

#include <array>
#include <atomic>
#include <cstring>
#include <string_view>

#include "mjcf/names.h"
#include "native_model/scene/reader.h"

namespace rotorub::plugin {
namespace {

namespace names = mjcf_names;

const char* custom_text(const mjModel* m, std::string_view name) {
  for (int i = 0; i < m->ntext; ++i) {
    if (name == m->names + m->name_textadr[i]) return m->text_data + m->text_adr[i];
  }
  return nullptr;
}

std::string in_text(const char* name, const std::string& reason) {
  return "rotorub: <custom><text name=\"" + std::string(name) + "\">: " + reason;
}

int required(const mjModel* m, int type, const char* element, const std::string& name) {
  const int id = mj_name2id(m, type, name.c_str());
  if (id < 0) {
    throw ConfigError("rotorub: <" + std::string(element) + " name=\"" + name +
                      "\">: missing, but the scene in <custom> needs it; write the MJCF anew with "
                      "`rotorub mjcf`");
  }
  return id;
}

// Coordinate i of the layout moves with this joint.
std::string joint_name(const Layout& l, int i) {
  if (i < l.y()) return names::bending_joint('x', i + 1);
  if (i < l.phi()) return names::bending_joint('y', i - l.y() + 1);
  if (i < l.theta()) return names::kSpinJoint;
  if (i < l.ring()) return names::torsion_joint(i - l.theta() + 1);
  return i == l.ring() ? names::kRingX : names::kRingY;
}

void map_joints(const mjModel* m, Config& config) {
  const Layout& l = config.model.layout;
  config.same_order = true;
  for (int i = 0; i < l.nq(); ++i) {
    const std::string name = joint_name(l, i);
    const int joint = required(m, mjOBJ_JOINT, "joint", name);
    const int type = m->jnt_type[joint];
    if (type != mjJNT_SLIDE && type != mjJNT_HINGE) {
      throw ConfigError("rotorub: <joint name=\"" + name + "\">: accepted types: slide, hinge");
    }
    config.qpos_address.push_back(m->jnt_qposadr[joint]);
    config.dof_address.push_back(m->jnt_dofadr[joint]);
    config.same_order =
        config.same_order && config.qpos_address.back() == i && config.dof_address.back() == i;
  }
}

scene::ContactModel contact_model(const mjModel* m, const scene::Scene& scene) {
  const char* text = custom_text(m, names::kContactText);
  if (!text) return scene.mujoco.contact;
  const std::string_view name = text;
  if (name == "coulomb") return scene::ContactModel::kCoulomb;
  if (name == "cone") return scene::ContactModel::kCone;
  throw ConfigError(
      in_text(names::kContactText, "\"" + std::string(name) + "\"; accepted: coulomb, cone"));
}

void map_contact(const mjModel* m, Config& config) {
  config.rotor_geom = required(m, mjOBJ_GEOM, "geom", names::kRotorContact);
  config.ring_geom = required(m, mjOBJ_GEOM, "geom", names::kRingContact);
  const auto check = [&](int geom, const char* name, int type, const char* accepted) {
    if (m->geom_type[geom] == type) return;
    throw ConfigError("rotorub: <geom name=\"" + std::string(name) +
                      "\">: accepted type: " + accepted);
  };
  check(config.rotor_geom, names::kRotorContact, mjGEOM_SPHERE, "sphere");
  check(config.ring_geom, names::kRingContact, mjGEOM_CAPSULE, "capsule");
  for (int i = 0; i < m->npair; ++i) {
    const int a = m->pair_geom1[i], b = m->pair_geom2[i];
    if ((a == config.rotor_geom && b == config.ring_geom) ||
        (a == config.ring_geom && b == config.rotor_geom)) {
      config.pair = i;
    }
  }
  if (config.pair < 0) {
    throw ConfigError("rotorub: <contact><pair geom1=\"" + std::string(names::kRotorContact) +
                      "\" geom2=\"" + names::kRingContact +
                      "\">: missing, but the scene in <custom> has a contact");
  }
}

void map_actuators(const mjModel* m, Config& config) {
  for (int k = 0; k < 2; ++k) {
    // A controller cannot do without; a passive bearing has them for the user's own commands.
    config.actuator[k] = config.model.controller
                             ? required(m, mjOBJ_ACTUATOR, "actuator", names::kActuator[k])
                             : mj_name2id(m, mjOBJ_ACTUATOR, names::kActuator[k]);
  }
}

void map_sensors(const mjModel* m, Config& config) {
  const auto address = [&](const char* name, int dim) {
    const int id = mj_name2id(m, mjOBJ_SENSOR, name);
    if (id < 0 || m->sensor_type[id] != mjSENS_USER) return -1;  // taken out, or another's
    if (m->sensor_dim[id] != dim) {
      throw ConfigError("rotorub: <user name=\"" + std::string(name) +
                        "\">: accepted dim: " + std::to_string(dim));
    }
    return m->sensor_adr[id];
  };
  SensorAddresses& s = config.sensors;
  s.active = address(names::kActive, 1);
  s.gap = address(names::kGap, 1);
  s.gap_rate = address(names::kGapRate, 1);
  s.slip = address(names::kSlip, 1);
  s.normal_force = address(names::kNormalForce, 1);
  s.friction_force = address(names::kFrictionForce, 1);
  s.control_force = address(names::kControlForce, 2);
}

// Sizes, custom text and names: a model with the same is mapped in the same way.
std::array<int, 8> sizes(const mjModel* m) {
  return {m->nq, m->nv, m->nu, m->njnt, m->ngeom, m->nsensor, m->ntextdata, m->nnames};
}

}  // namespace

const char* scene_text(const mjModel* m) { return custom_text(m, names::kSceneText); }

bool same_fingerprint(const Config& config, const mjModel* m) {
  const std::array<int, 8> s = sizes(m);
  const auto text = static_cast<std::size_t>(m->ntextdata);
  const auto named = static_cast<std::size_t>(m->nnames);
  const char* kept = config.fingerprint.data();
  return config.fingerprint.size() == sizeof s + text + named &&
         std::memcmp(kept, s.data(), sizeof s) == 0 &&
         std::memcmp(kept + sizeof s, m->text_data, text) == 0 &&
         std::memcmp(kept + sizeof s + text, m->names, named) == 0;
}

Config make_config(const mjModel* m) {
  static std::atomic<int> count{0};
  Config config;
  scene::Scene scene;
  try {
    scene = scene::parse_scene(scene_text(m), names::kSceneText);
    config.model = make_model(scene);
  } catch (const std::exception& error) {
    throw ConfigError(in_text(names::kSceneText, error.what()));
  }
  if (scene.mujoco.rotor == scene::MujocoRotor::kSegments) {
    throw ConfigError(in_text(names::kSceneText, "mujoco.rotor: accepted: \"modal\""));
  }
  const int needed = names::user_data_size(config.model.nq(), config.model.controller != nullptr);
  if (m->nuserdata < needed) {
    throw ConfigError("rotorub: <size nuserdata>: at least " + std::to_string(needed) + " needed");
  }
  map_joints(m, config);
  if (scene.contact) {
    config.contact = contact_model(m, scene);
    map_contact(m, config);
  }
  map_actuators(m, config);
  map_sensors(m, config);
  const std::array<int, 8> s = sizes(m);
  config.fingerprint.resize(sizeof s);
  std::memcpy(config.fingerprint.data(), s.data(), sizeof s);
  config.fingerprint.append(m->text_data, static_cast<std::size_t>(m->ntextdata));
  config.fingerprint.append(m->names, static_cast<std::size_t>(m->nnames));
  config.id = 1.0 + count.fetch_add(1);
  return config;
}

}  // namespace rotorub::plugin
