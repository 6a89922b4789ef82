// Checks the bodies, joints and actuators of a generated file against the mode shapes of its scene.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "mjcf/names.h"
#include "plugin/model/message.h"
#include "plugin/model/mujoco_actuators.h"
#include "plugin/model_parameters.h"

namespace rotorub::plugin {
namespace {

namespace names = mjcf_names;

constexpr double kRoundOff = 1e-12;

bool is_above(const mjModel* m, int body, int above) {  // or the same body
  while (body > 0 && body != above) body = m->body_parentid[body];
  return body == above;
}

// The native axes are those of the world, and the ring's place is determined by its joints and its
// offset.
void check_pose(const mjModel* m, int body, const Eigen::Vector2d& offset) {
  const mjtNum* p = m->body_pos + 3 * body;
  const mjtNum* q = m->body_quat + 4 * body;
  if (p[0] != offset.x() || p[1] != offset.y()) {
    refuse(body_element(m, body),
           message("pos=\"{} {} {}\" must have x {} and y {}, as in the scene", p[0], p[1], p[2],
                   offset.x(), offset.y()));
  }
  if (std::abs(q[0]) < 1.0 - kRoundOff) {
    refuse(body_element(m, body),
           message("quat=\"{} {} {} {}\" is a rotation; remove it", q[0], q[1], q[2], q[3]));
  }
}

// The body's own x and y must be `offset`; those of its ancestors must be 0.
void check_poses(const mjModel* m, int body, Eigen::Vector2d offset) {
  for (; body > 0; body = m->body_parentid[body]) {
    check_pose(m, body, offset);
    offset.setZero();
  }
}

void check_joint(const mjModel* m, int joint, int along, const char* due) {
  const std::string element = joint_element(m, joint);
  const mjtNum* axis = m->jnt_axis + 3 * joint;
  if (std::abs(axis[along] - 1.0) > kRoundOff) {
    refuse(element, message("axis=\"{} {} {}\" must be \"{}\"", axis[0], axis[1], axis[2], due));
  }
  const double reference = m->qpos0[m->jnt_qposadr[joint]];
  if (reference != 0.0) refuse(element, message("ref=\"{}\" must be 0", reference));
}

// A mode moves the contact by 1 if its joint is above the rotor's body, else by 0.
void check_mode(const mjModel* m, int joint, int rotor, double shape) {
  const bool carries = is_above(m, rotor, m->jnt_bodyid[joint]);
  if (carries == (shape == 1.0)) return;
  refuse(joint_element(m, joint),
         message("moves the contact by {} of its value, the scene's mode by {}; write the MJCF "
                 "anew with `rotorub mjcf`",
                 carries ? 1 : 0, shape));
}

void check_chain(const mjModel* m, const Config& config) {
  const Layout& l = config.model.layout;
  const int rotor = m->geom_bodyid[config.pairs.front().rotor_geom];
  check_poses(m, rotor, Eigen::Vector2d::Zero());
  for (int i = 0; i < l.ring(); ++i) {
    const int dof = config.dof_address[static_cast<std::size_t>(i)];
    const int joint = m->dof_jntid[dof];
    if (i < l.y()) {
      check_joint(m, joint, 0, "1 0 0");
      check_mode(m, joint, rotor, config.model.first().shape.x[i]);
    } else if (i < l.phi()) {
      check_joint(m, joint, 1, "0 1 0");
      check_mode(m, joint, rotor, config.model.first().shape.y[i - l.y()]);
    } else {
      check_joint(m, joint, 2, "0 0 1");
      const double shape = i < l.theta() ? 1.0 : config.model.first().torsion_shape[i - l.theta()];
      check_mode(m, joint, rotor, shape);
    }
  }
}

void check_rings(const mjModel* m, const Config& config) {
  for (const ContactPair& pair : config.pairs) {
    check_poses(m, m->geom_bodyid[pair.ring_geom],
                config.model.auxiliary[pair.bearing].ring_offset);
  }
  for (const AuxiliaryBearing& at : config.model.auxiliary) {
    const auto check = [&](int coordinate, int axis, const char* along) {
      const int dof = config.dof_address[static_cast<std::size_t>(coordinate)];
      check_joint(m, m->dof_jntid[dof], axis, along);
    };
    if (at.moves()) check(at.ring, 0, "1 0 0"), check(at.ring + 1, 1, "0 1 0");
    if (at.turns()) check(at.ring_angle, 2, "0 0 1");
    if (at.housing != kAbsent) check(at.housing, 0, "1 0 0"), check(at.housing + 1, 1, "0 1 0");
  }
}

// Checks that the actuator acts along its axis of the scene, with a gear of 1 and without a force
// limit of its own.
void check_actuator(const mjModel* m, int k, int actuator) {
  const std::string element = message("<actuator name=\"{}\">", names::kActuator[k]);
  const mjtNum gear = m->actuator_gear[6 * force_address(m, actuator)];
  if (gear != 1.0) {
    refuse(element, message("gear=\"{}\" must be 1", gear));
  }
  if (m->actuator_forcelimited[actuator]) {
    refuse(element, "has a forcerange; use a ctrlrange, or force_limit in the scene");
  }
  const int tendon = mj_name2id(m, mjOBJ_TENDON, names::kAxis[k]);
  if (m->actuator_trntype[actuator] != mjTRN_TENDON || tendon < 0 ||
      m->actuator_trnid[2 * actuator] != tendon) {
    refuse(element, message("needs tendon=\"{}\"", names::kAxis[k]));
  }
  const double share = std::sqrt(0.5);
  const double due[2] = {k == 0 ? share : -share, share};
  const int first = m->tendon_adr[tendon];
  for (int w = 0; w < m->tendon_num[tendon]; ++w) {
    const int joint = m->wrap_objid[first + w];
    const std::string name = m->names + m->name_jntadr[joint];
    const int plane = name == names::kRingX ? 0 : name == names::kRingY ? 1 : -1;
    const double given = m->wrap_prm[first + w];
    if (plane >= 0 && std::abs(given - due[plane]) <= kRoundOff) continue;
    refuse(message("<fixed name=\"{}\">", names::kAxis[k]),
           message("joint \"{}\" has coef=\"{}\", but ring_x must have {} and ring_y {}", name,
                   given, due[0], due[1]));
  }
}

std::vector<int> bodies_of_chain(const mjModel* m, const Config& config) {
  std::vector<int> bodies;
  for (int i = 0; i < config.model.layout.ring(); ++i) {
    const int body = m->dof_bodyid[config.dof_address[static_cast<std::size_t>(i)]];
    if (std::ranges::find(bodies, body) == bodies.end()) bodies.push_back(body);
  }
  return bodies;
}

int shape(const mjModel* m, const std::string& name) {
  const int geom = mj_name2id(m, mjOBJ_GEOM, name.c_str());
  return geom >= 0 && m->geom_type[geom] == mjGEOM_CYLINDER ? geom : -1;
}

}  // namespace

void map_structure(const mjModel* m, Config& config) {
  const Model& model = config.model;
  if (model.first().magnets) config.scene_current_limit = model.first().magnets->current_limit;
  for (std::size_t k = 0; k < config.pairs.size(); ++k) {
    config.pairs[k].rotor_shape = shape(m, names::of_bearing(k, names::kRotor));
    config.pairs[k].ring_shape = shape(m, names::of_bearing(k, names::kRing));
  }
  if (config.has_contact() && !config.segments) config.rotor_bodies = bodies_of_chain(m, config);
  check_structure(m, config);
}

void check_structure(const mjModel* m, const Config& config) {
  if (config.own) return;
  const Model& model = config.model;
  if (config.has_contact()) {
    check_rings(m, config);
    if (!config.segments) check_chain(m, config);
  }
  if (model.first().controller || model.first().magnets) {
    for (int k = 0; k < 2; ++k) check_actuator(m, k, config.actuator[k]);
  }
}

}  // namespace rotorub::plugin
