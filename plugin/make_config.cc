#include "plugin/make_config.h"

#include <atomic>

#include "mjcf/names.h"
#include "native_model/model/model_checks.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/scene.h"
#include "native_model/stepping/stepper.h"
#include "native_model/stepping/zero_order_hold.h"
#include "plugin/contact/verlet.h"
#include "plugin/fingerprint.h"
#include "plugin/load_cells.h"
#include "plugin/model/contact_sensors.h"
#include "plugin/model/generated_rotor.h"
#include "plugin/model/later_attributes.h"
#include "plugin/model/message.h"
#include "plugin/model/mujoco_versions.h"
#include "plugin/model/user_data.h"
#include "plugin/model_parameters.h"
#include "plugin/own/own_config.h"
#include "plugin/own/own_names.h"
#include "plugin/own/pair_checks.h"
#include "plugin/shadow.h"

namespace rotorub::plugin {
namespace {

namespace names = mjcf_names;

int required(const mjModel* m, int type, const char* element, const std::string& name) {
  const int id = mj_name2id(m, type, name.c_str());
  if (id < 0) {
    refuse(message("<{} name=\"{}\">", element, name),
           "missing, but the scene in <custom> needs it; write the MJCF anew with `rotorub mjcf`");
  }
  return id;
}

// The joint of coordinate i of the layout.
std::string joint_name(const Model& model, int i) {
  const Layout& l = model.layout;
  if (i < l.y()) return names::bending_joint('x', i + 1);
  if (i < l.phi()) return names::bending_joint('y', i - l.y() + 1);
  if (i < l.theta()) return names::kSpinJoint;
  if (i < l.ring()) return names::torsion_joint(i - l.theta() + 1);
  if (i >= l.feedback_state()) return names::bearing_integral(i - l.feedback_state());
  for (std::size_t k = 0; k < model.auxiliary.size(); ++k) {
    const AuxiliaryBearing& at = model.auxiliary[k];
    if (i == at.ring) return names::of_bearing(k, names::kRingX);
    if (i == at.ring + 1 && at.moves()) return names::of_bearing(k, names::kRingY);
    if (i == at.ring_angle) return names::of_bearing(k, names::kRingSpin);
    if (at.housing == kAbsent) continue;
    if (i == at.housing) return names::of_bearing(k, names::kHousingX);
    if (i == at.housing + 1) return names::of_bearing(k, names::kHousingY);
  }
  for (const StationSupport& s : model.supports) {
    const auto named = [&](const char* name) { return names::of_bearing(s.number, name); };
    if (i == s.spin_bristle) return named(names::kSpinBristle);
    if (s.bristle == kAbsent) continue;
    if (i == s.bristle) return named(names::kBristleX);
    if (i == s.bristle + 1) return named(names::kBristleY);
  }
  return {};
}

JointAddress find_joint(const mjModel* m, const std::string& name) {
  const int joint = required(m, mjOBJ_JOINT, "joint", name);
  const int type = m->jnt_type[joint];
  if (type != mjJNT_SLIDE && type != mjJNT_HINGE) {
    refuse(joint_element(m, joint), "must be a slide or a hinge");
  }
  return {m->jnt_qposadr[joint], m->jnt_dofadr[joint]};
}

void map_segments(const mjModel* m, const scene::Scene& scene, Config& config) {
  const auto find = [m](const std::string& name) { return find_joint(m, name); };
  const Layout& l = config.model.layout;
  config.segments = make_segments(scene, config.model, find);
  config.qpos_address.assign(static_cast<std::size_t>(l.nq()), -1);
  config.dof_address = config.qpos_address;
  for (int i = l.ring(); i < l.nq(); ++i) {
    const JointAddress ring = find(joint_name(config.model, i));
    config.qpos_address[static_cast<std::size_t>(i)] = ring.position;
    config.dof_address[static_cast<std::size_t>(i)] = ring.velocity;
  }
}

void map_joints(const mjModel* m, Config& config) {
  const Layout& l = config.model.layout;
  config.same_order = true;
  for (int i = 0; i < l.nq(); ++i) {
    const JointAddress joint = find_joint(m, joint_name(config.model, i));
    config.qpos_address.push_back(joint.position);
    config.dof_address.push_back(joint.velocity);
    config.same_order =
        config.same_order && config.qpos_address.back() == i && config.dof_address.back() == i;
  }
}

// The k-th contact; userdata: index of its entries in mjData.userdata.
ContactPair map_contact(const mjModel* m, const Config& config, std::size_t k,
                        scene::ContactModel contact_model, int userdata) {
  const std::string rotor = names::of_bearing(k, names::kRotorContact);
  const std::string ring = names::of_bearing(k, names::kRingContact);
  const auto geom = [m](const std::string& name, int type, const char* shape) {
    const int id = required(m, mjOBJ_GEOM, "geom", name);
    if (m->geom_type[id] != type) {
      refuse(message("<geom name=\"{}\">", name), message("must be a {}", shape));
    }
    return id;
  };
  ContactPair p;
  p.contact_model = contact_model;
  p.contact = p.given = *config.model.auxiliary[k].contact;
  p.rotor_geom = geom(rotor, mjGEOM_SPHERE, "sphere");
  p.ring_geom = geom(ring, mjGEOM_CAPSULE, "capsule");
  p.pair = find_pair(m, p.rotor_geom, p.ring_geom);
  if (p.pair < 0) {
    refuse(message("<contact><pair geom1=\"{}\" geom2=\"{}\">", rotor, ring),
           "missing, but the scene in <custom> has a contact");
  }
  p.userdata = userdata;
  p.sensors = contact_sensors(m, {}, names::of_bearing(k, {}));
  p.friction_reference = own_value(m, names::kOwnFrictionReference).value_or(0.0);
  p.in_world = true;
  p.on_chain = !config.segments;
  p.further = p.on_chain && k > 0;
  p.bearing = k;
  if (p.further && m->body_mocapid[m->geom_bodyid[p.rotor_geom]] < 0) {
    refuse(body_element(m, m->geom_bodyid[p.rotor_geom]),
           message("carries geom \"{}\", so it needs mocap=\"true\"", rotor));
  }
  p.prescribed_spin = config.segments ? 0.0 : config.model.prescribed_spin();
  return p;
}

// further: index in mjData.userdata of the memory of the contacts beyond the first.
void map_contacts(const mjModel* m, Config& config, scene::ContactModel contact_model,
                  int further) {
  for (std::size_t k = 0; k < config.model.auxiliary.size(); ++k) {
    const int userdata =
        k == 0 ? kFirstContact : further + kEntries<ContactEntries> * static_cast<int>(k - 1);
    config.pairs.push_back(map_contact(m, config, k, contact_model, userdata));
  }
}

void check_magnet(const mjModel* m, bool lags, int actuator) {
  const bool force = m->actuator_gaintype[actuator] == mjGAIN_USER &&
                     m->actuator_biastype[actuator] == mjBIAS_USER;
  const bool current = m->actuator_dyntype[actuator] == (lags ? mjDYN_USER : mjDYN_NONE);
  if (force && current) return;
  refuse(message("<general name=\"{}\">", m->names + m->name_actuatoradr[actuator]),
         message("is a magnet, so it needs gaintype=\"user\" biastype=\"user\" dyntype=\"{}\"",
                 lags ? "user" : "none"));
}

void map_actuators(const mjModel* m, Config& config) {
  const AuxiliaryBearing& ring = config.model.first();
  for (int k = 0; k < 2; ++k) {
    // A controller or magnets need the actuators; otherwise they are for the user's own commands.
    config.actuator[k] = ring.controller || ring.magnets
                             ? required(m, mjOBJ_ACTUATOR, "actuator", names::kActuator[k])
                             : mj_name2id(m, mjOBJ_ACTUATOR, names::kActuator[k]);
    if (ring.magnets) check_magnet(m, ring.lags(), config.actuator[k]);
  }
}

double next_id() {
  static std::atomic<int> count{0};
  return 1.0 + count.fetch_add(1);
}

// Turns exceptions of the scene's own code into a refusal of its text.
template <typename Read>
void read_scene(Read read) {
  try {
    read();
  } catch (const ConfigError&) {
    throw;
  } catch (const std::exception& error) {
    refuse(text_element(names::kSceneText), error.what());
  }
}

// Assigns the memories of the plugin's parts in mjData.userdata. Returns the index of the memory of
// the contacts beyond the first.
int map_memory(const mjModel* m, const scene::Scene& scene, Config& config) {
  const AuxiliaryBearing& ring = config.model.first();
  const std::size_t loop = ring.loop ? ring.loop->memory_size() : 0;
  int needed = names::user_data_size(config.model.nq(), ring.controller != nullptr, loop);
  config.loop_data = needed - static_cast<int>(loop);
  if (scene.has_contact() && scene.mujoco.rotor != scene::MujocoRotor::kSegments &&
      !scene.is_compliant()) {
    config.verlet_data = needed;
    needed += names::verlet_data_size(config.model.nq(), ZeroOrderHold::memory_size(config.model),
                                      VerletStepper::memory_size(config.model));
  }
  if (config.shadow) {
    config.shadow->userdata = needed;
    needed += names::shadow_data_size(ZeroOrderHold::memory_size(config.shadow->model),
                                      VerletStepper::memory_size(config.shadow->model));
  }
  const int further = needed;
  needed += kEntries<ContactEntries> * static_cast<int>(scene.auxiliary.size() - 1);
  if (m->nuserdata < needed) {
    refuse("<size nuserdata>",
           message("set nuserdata=\"{}\" or more, or write the model again with `rotorub mjcf`",
                   needed));
  }
  return further;
}

// Impacts of finite duration with `rigid` are possible in the native step alone.
void check_impacts(const scene::Scene& scene, const Config& config) {
  if (config.contact_model() != scene::ContactModel::kRigid) return;
  const bool lags = config.model.first().lags();
  const bool native = config.takes_native_steps() && !config.shadow && !lags;
  read_scene([&] {
    refuse_finite_impacts(scene, native ? FiniteImpacts::kUnsampled : FiniteImpacts::kNone);
  });
}

Config own_config(const mjModel* m) {
  Config config;
  map_own_contacts(m, config);
  return config;
}

Config generated_config(const mjModel* m) {
  refuse_own_names(m);
  Config config;
  scene::Scene scene;
  read_scene([&] {
    scene = scene::parse_scene(scene_text(m), names::kSceneText);
    refuse_several_in_mujoco(scene);
    const Model whole = prepare(scene);
    config.model = without_coils(whole);
    if (scene.mujoco.shadow) {
      config.shadow.emplace().model = whole.first().controller ? whole : with_ideal_actuator(whole);
    }
  });
  const int further = map_memory(m, scene, config);
  if (scene.mujoco.rotor == scene::MujocoRotor::kSegments) {
    read_scene([&] { map_segments(m, scene, config); });
  } else {
    map_joints(m, config);
  }
  if (scene.has_contact()) {
    const scene::ContactModel model = contact_model(m, names::kContactText, scene.mujoco.contact);
    if (!config.segments && scene.auxiliary.size() > 1 && scene::is_cone(model)) {
      refuse(text_element(names::kContactText),
             "MuJoCo's cone supports only one contact of the modal chain; for several choose rigid "
             "or coulomb, or a scene with mujoco.rotor = \"segments\"");
    }
    map_contacts(m, config, model, further);
    for (const scene::AuxiliaryBearing& at : scene.auxiliary) {
      if (!scene::is_cone(model) || at.contact->friction.is_constant()) continue;
      refuse(text_element(names::kContactText),
             "MuJoCo's cone has one coefficient for all slips, but the scene's friction depends on "
             "the slip; choose rigid or coulomb");
    }
    Refusals refusals;
    for (const ContactPair& pair : config.pairs) check_solved_part(m, pair, refusals);
    refusals.raise();
    if (!config.segments) choose_path(m, config);
    if (config.takes_native_steps()) config.loop_data = verlet_loop_data(config);
    check_impacts(scene, config);
  }
  map_actuators(m, config);
  config.active = sensor_address(m, names::kActive, 1);
  config.control_force = sensor_address(m, names::kControlForce, 2);
  config.current = sensor_address(m, names::kCurrent, 2);
  map_structure(m, config);
  check_generated_attributes(m, config);
  take_parameters(m, config);
  return config;
}

}  // namespace

bool is_ours(const mjModel* m) { return scene_text(m) || has_own_names(m); }

Config make_config(const mjModel* m) {
  Config config = scene_text(m) ? generated_config(m) : own_config(m);
  map_load_cells(m, config);
  if (config.shadow) map_shadow(m, *config.shadow);
  config.fingerprint = fingerprint(m);
  config.id = next_id();
  return config;
}

Config with_parameters(const Config& config, const mjModel* m) {
  if (config.own || damping_is_added(m, config) != config.damping_added) return make_config(m);
  Config other = config;
  take_parameters(m, other);
  other.id = next_id();
  return other;
}

}  // namespace rotorub::plugin
