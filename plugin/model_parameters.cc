#include "plugin/model_parameters.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mjcf/names.h"
#include "native_model/model/dynamics.h"
#include "plugin/model/generated_rotor.h"
#include "plugin/model/message.h"
#include "plugin/model/mujoco_actuators.h"
#include "plugin/own/own_config.h"
#include "plugin/shadow.h"

namespace rotorub::plugin {
namespace {

namespace names = mjcf_names;

// kg. A generated body weighs 1e-12; a mass above this limit was added by a user.
constexpr double kMassless = 1e-9;

// Calls action(i, dof) for each coordinate of the native layout that is a joint in MuJoCo.
template <typename Action>
void for_each_joint(const Config& config, Action action) {
  for (int i = 0; i < config.model.nq(); ++i) {
    const int dof = config.dof_address[static_cast<std::size_t>(i)];
    if (dof >= 0) action(i, dof);
  }
}

// kg m^2, moment of inertia of the body about its z axis, on which its joints are.
double turning_inertia(const mjModel* m, int body) {
  mjtNum axes[9];
  mju_quat2Mat(axes, m->body_iquat + 4 * body);
  const mjtNum* centre = m->body_ipos + 3 * body;
  double sum = m->body_mass[body] * (centre[0] * centre[0] + centre[1] * centre[1]);
  for (int k = 0; k < 3; ++k) sum += axes[6 + k] * axes[6 + k] * m->body_inertia[3 * body + k];
  return sum;
}

// The entry on the diagonal of MuJoCo's mass matrix. For a dof that MuJoCo calls simple it is the
// value of the last mj_setConst, not the present armature. A mass on the ring moves with both of
// its slides, and its inertia with its hinge, so both are added to the ring's.
double mass_of(const Config& config, const mjModel* m, int i, int dof) {
  const double armature = m->dof_armature[dof];
  double mass = armature;
  if (m->dof_simplenum[dof] > 0) {
    mass = m->dof_M0[dof];
  } else if (i >= config.model.layout.ring()) {
    const int body = m->dof_bodyid[dof];
    mass += config.model.layout.turns(i) ? turning_inertia(m, body) : m->body_mass[body];
  }
  return std::abs(mass - armature) > kMassless ? mass : armature;
}
double stiffness_of(const mjModel* m, int dof) { return m->jnt_stiffness[m->dof_jntid[dof]]; }

Eigen::Vector2d gravity_of(const mjModel* m) {
  if (m->opt.disableflags & mjDSBL_GRAVITY) return {0.0, 0.0};
  return {m->opt.gravity[0], m->opt.gravity[1]};
}

double friction_of(const ContactPair& pair, const mjModel* m) {
  return m->pair_friction[5 * pair.pair];
}

// The limit of a controller's commands, N or A; `otherwise` if MuJoCo has none.
double limit_of(const Config& config, const mjModel* m, double otherwise) {
  const int a = control_address(m, config.actuator[0]);
  const bool clamps = m->actuator_ctrllimited[a] && !(m->opt.disableflags & mjDSBL_CLAMPCTRL);
  return clamps ? m->actuator_ctrlrange[2 * a + 1] : otherwise;
}
// True if both actuators have the same limits -c and c, or none.
bool limits_agree(const mjModel* m, const Config& config) {
  const int a = control_address(m, config.actuator[0]), b = control_address(m, config.actuator[1]);
  const mjtNum* first = m->actuator_ctrlrange + 2 * a;
  const mjtNum* second = m->actuator_ctrlrange + 2 * b;
  return first[0] == -first[1] && first[0] == second[0] && first[1] == second[1] &&
         m->actuator_ctrllimited[a] == m->actuator_ctrllimited[b];
}
double limit_in(const AuxiliaryBearing& ring) {
  return ring.magnets ? ring.magnets->current_limit : ring.force_limit;
}
double scene_limit(const Config& config) {
  return config.model.first().magnets ? config.scene_current_limit
                                      : std::numeric_limits<double>::infinity();
}

struct Circle {
  double radius, clearance;  // m
  bool operator==(const Circle&) const = default;
};

// The contact's circles as they are drawn. If they equal those of the scene, the scene's numbers
// are used, because sum and difference would differ from them by round-off.
Circle circle_of(const ContactPair& pair, const mjModel* m) {
  const Circle scene{pair.given.radius, pair.given.clearance};
  if (pair.rotor_shape < 0 || pair.ring_shape < 0) return scene;
  const double rotor = m->geom_size[3 * pair.rotor_shape];
  const double ring = m->geom_size[3 * pair.ring_shape];
  const bool same = rotor == scene.radius && ring == scene.radius + scene.clearance;
  return same ? scene : Circle{rotor, ring - rotor};
}

// True if the numbers that a user's own model takes from its geoms and pair (own/own_config.h) are
// unchanged.
bool has_own_numbers(const Config& config, const mjModel* m) {
  return std::all_of(config.pairs.begin(), config.pairs.end(),
                     [m](const ContactPair& p) { return p.read == own_numbers(m, p); });
}

bool rotor_is_massless(const Config& config, const mjModel* m) {
  return std::ranges::none_of(config.rotor_bodies, [m](int body) {
    return m->body_mass[body] > kMassless || m->body_subtreemass[body] > kMassless;
  });
}

void check_joint_numbers(const mjModel* m, int joint, double mass, double stiffness,
                         double damping) {
  const auto check = [&](const char* what, double value, bool fits, const char* due) {
    if (fits) return;
    refuse(joint_element(m, joint), message("{}=\"{}\" must be {}", what, value, due));
  };
  check("armature", mass, mass > 0.0 && std::isfinite(mass), "> 0, the mass of the mode");
  check("stiffness", stiffness, stiffness >= 0.0 && std::isfinite(stiffness), ">= 0");
  check("damping", damping, damping >= 0.0 && std::isfinite(damping), ">= 0");
}

void check_masses(const mjModel* m, const Config& config) {
  for (const int body : config.rotor_bodies) {
    if (m->body_mass[body] <= kMassless && m->body_subtreemass[body] <= kMassless) continue;
    refuse(body_element(m, body),
           message("carries {} kg, generated with 1e-12: it would couple the modes, whose masses "
                   "are their joints' armature; put masses in the scene ([[rotor.disc]]), and "
                   "write the MJCF anew",
                   std::max(m->body_mass[body], m->body_subtreemass[body])));
  }
}

// Mass off the axis of a ring that turns is an unbalance, which the native ring does not have.
void check_ring_mass(const mjModel* m, const Config& config, const AuxiliaryBearing& at) {
  if (!at.turns()) return;
  const int body = m->dof_bodyid[config.dof_address[static_cast<std::size_t>(at.ring_angle)]];
  const mjtNum* centre = m->body_ipos + 3 * body;
  if (m->body_mass[body] <= kMassless || (centre[0] == 0.0 && centre[1] == 0.0)) return;
  refuse(
      body_element(m, body),
      message("its centre of mass is at {} {}, off the axis about which it turns; set x and y to 0",
              centre[0], centre[1]));
}

void take_joints(const mjModel* m, Model& model, const Config& config) {
  for_each_joint(config, [&](int i, int dof) {
    if (i >= model.nq()) return;
    const double mass = mass_of(config, m, i, dof);
    check_joint_numbers(m, m->dof_jntid[dof], mass, stiffness_of(m, dof), m->dof_damping[dof]);
    if (i >= model.layout.ring() && i < model.layout.ring() + model.layout.stator)
      model.gravity_mass[i] = mass;
    model.mass[i] = mass;
    model.stiffness[i] = stiffness_of(m, dof);
    model.damping[i] = m->dof_damping[dof];
  });
}

void take_contact(const mjModel* m, Model& model, const Config& config, std::size_t k) {
  const Circle circle = circle_of(config.pairs[k], m);
  if (!(circle.radius > 0.0) || !(circle.clearance > 0.0)) {
    refuse("<geom name=\"" + names::of_bearing(k, names::kRing) + "\">",
           message("size[0] = {} is not greater than the rotor's radius, {} m",
                   circle.radius + circle.clearance, circle.radius));
  }
  const double friction = friction_of(config.pairs[k], m);
  if (!(friction >= 0.0) || !std::isfinite(friction)) {
    refuse("<contact><pair>", message("friction[0] = {} must be >= 0", friction));
  }
  AuxiliaryBearing& at = model.auxiliary[k];
  at.contact->radius = circle.radius;
  at.contact->clearance = circle.clearance;
  FrictionLaw& law = at.contact->friction;
  if (friction != law.sticking()) {
    if (!law.is_constant()) {
      refuse(
          "<contact><pair>",
          message("friction[0] = {} must be {}, because the scene's friction depends on the slip",
                  friction, law.sticking()));
    }
    law.coefficient = friction;
  }
  at.ring_ratio = at.contact->surface_ratio();
}

void take_limit(const mjModel* m, AuxiliaryBearing& ring, const Config& config) {
  const int a = control_address(m, config.actuator[0]), b = control_address(m, config.actuator[1]);
  const mjtNum* first = m->actuator_ctrlrange + 2 * a;
  const mjtNum* second = m->actuator_ctrlrange + 2 * b;
  const double limit = limit_of(config, m, scene_limit(config));
  if (limit < std::numeric_limits<double>::infinity() &&
      (!limits_agree(m, config) || !(limit > 0.0))) {
    refuse(message("<actuator name=\"{}\">", names::kActuator[0]),
           message("ctrlrange is {} {}, and \"{}\" has {} {}; the scene's controller needs -c c "
                   "with c > 0, the same for both",
                   first[0], first[1], names::kActuator[1], second[0], second[1]));
  }
  (ring.magnets ? ring.magnets->current_limit : ring.force_limit) = limit;
}

void take(const mjModel* m, Model& model, const Config& config) {
  take_joints(m, model, config);
  for (std::size_t k = 0; k < config.pairs.size(); ++k) take_contact(m, model, config, k);
  if (model.first().controller) take_limit(m, model.first(), config);
  const Eigen::Vector2d g = gravity_of(m);
  if (model.weight.size() > 0 || !g.isZero(0.0)) set_gravity(model, g);
  for (std::size_t k = 0; k < model.auxiliary.size(); ++k) {
    model.auxiliary[k].admittance =
        contact_admittance(model, model.mass.data(), 0.0, model.q0.data(), k, k);
  }
}

}  // namespace

bool has_parameters(const Config& config, const mjModel* m) {
  if (config.own) return has_own_numbers(config, m);
  const Model& model = config.model;
  bool same = gravity_of(m) == config.gravity && rotor_is_massless(config, m) &&
              damping_is_added(m, config) == config.damping_added;
  for_each_joint(config, [&](int i, int dof) {
    same = same && mass_of(config, m, i, dof) == model.mass[i] &&
           stiffness_of(m, dof) == model.stiffness[i] && m->dof_damping[dof] == model.damping[i];
  });
  for (const ContactPair& pair : config.pairs) {
    const ContactParameters& c = pair.contact;
    same = same && circle_of(pair, m) == Circle{c.radius, c.clearance} &&
           friction_of(pair, m) == c.friction.sticking();
  }
  if (model.first().controller) {
    const double limit = limit_of(config, m, scene_limit(config));
    same = same && limit == limit_in(model.first()) &&
           (limit == std::numeric_limits<double>::infinity() || limits_agree(m, config));
  }
  return same;
}

void take_parameters(const mjModel* m, Config& config) {
  check_masses(m, config);
  for (const AuxiliaryBearing& at : config.model.auxiliary) check_ring_mass(m, config, at);
  take(m, config.model, config);
  for (std::size_t k = 0; k < config.pairs.size(); ++k) {
    config.pairs[k].contact = *config.model.auxiliary[k].contact;
  }
  config.gravity = gravity_of(m);
  if (!config.shadow) return;
  take(m, config.shadow->model, config);
  config.shadow->mark = mark_of(config.shadow->model);
}

}  // namespace rotorub::plugin
