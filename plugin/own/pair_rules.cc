#include "plugin/own/pair_rules.h"

#include <cmath>

#include "mjcf/names.h"
#include "mjcf/soft_contact.h"
#include "plugin/contact/axial_motion.h"
#include "plugin/message.h"

namespace rotorub::plugin {
namespace {

namespace names = mjcf_names;

// MuJoCo's solver bounces by solref; what <custom> says must be that.
void check_bounce(const mjModel* m, const PairName& name, const ContactPair& p) {
  constexpr double kScatter = 0.03;  // what MuJoCo's steps make of it is not finer
  if (p.contact.tangential_restitution > 0.0) {
    refuse(message("<custom><numeric name=\"{}\">", name.of(names::kOwnTangential)),
           "contact models coulomb and cone have none; accepted: 0, or contact model rigid");
  }
  if (!own_number(m, name.of(names::kOwnRestitution))) return;
  const double wanted = p.contact.restitution;
  const mjtNum* solref = m->pair_solref + mjNREF * p.pair;
  const bool direct = solref[0] <= 0.0;
  const double zeta = direct ? -solref[1] / (2.0 * std::sqrt(-solref[0])) : solref[1];
  const double met = soft_restitution(zeta);
  if (std::abs(met - wanted) <= kScatter) return;
  const SoftContact soft = soft_contact(wanted, m->opt.timestep);
  refuse(pair_element(m, p),
         message("solref bounces with {}, {} is {}; accepted: solref=\"{} {}\" "
                 "solimp=\"0.9999 0.9999 0.001\"",
                 met, name.of(names::kOwnRestitution), wanted, -soft.stiffness, -soft.damping));
}

void check_cone(const mjModel* m, const PairName& name, const ContactPair& p) {
  for (const char* force : {names::kNormalForce, names::kFrictionForce, names::kNormalForceScaled,
                            names::kFrictionForceScaled}) {
    const std::string sensor = name.of(force);
    const int id = mj_name2id(m, mjOBJ_SENSOR, sensor.c_str());
    if (id < 0 || m->sensor_type[id] != mjSENS_USER || m->sensor_needstage[id] == mjSTAGE_ACC)
      continue;
    refuse(
        message("<user name=\"{}\">", sensor),
        "contact model cone: the force is found by MuJoCo's solver; accepted: needstage=\"acc\"");
  }
  const double mu = p.contact.friction.coefficient, given = m->pair_friction[5 * p.pair];
  if (mu > 0.0 && m->pair_dim[p.pair] < 3) {
    refuse(pair_element(m, p), "contact model cone with friction: accepted: condim=\"3\" or more");
  }
  if (m->pair_dim[p.pair] >= 3 && std::abs(given - mu) > 1e-9 + mjMINMU) {
    refuse(pair_element(m, p), message("friction is {}, {} is {}; accepted: one value in both",
                                       given, name.of(names::kOwnFriction), mu));
  }
  const double along = m->pair_friction[5 * p.pair + 1];
  if (p.axial && std::abs(along - mu) > 1e-9 + mjMINMU) {
    refuse(
        pair_element(m, p),
        message("friction along the axis, the second value, is {}, {} is {}; accepted: one value "
                "in all three",
                along, name.of(names::kOwnFriction), mu));
  }
}

// A mocap body moves by its place alone: no velocity tells an impact of it.
void refuse_mocap(const mjModel* m, int geom) {
  const int root = m->body_rootid[m->geom_bodyid[geom]];
  if (m->body_mocapid[root] < 0) return;
  refuse(
      message("<body name=\"{}\" mocap=\"true\">", m->names + m->name_bodyadr[root]),
      message(
          "moves geom \"{}\" of a contact without a velocity; contact model rigid accepts: a body "
          "with joints, driven by actuators or by a weld to the mocap body",
          m->names + m->name_geomadr[geom]));
}

// `rigid` has its friction from <custom> alone. What a pair says of none is one of its geoms'.
void refuse_other_friction(const mjModel* m, const PairName& name, const ContactPair& p) {
  const double mu = p.contact.friction.coefficient, given = m->pair_friction[5 * p.pair];
  const auto from = [&](int geom) { return given == m->geom_friction[3 * geom]; };
  if (m->pair_dim[p.pair] < 3 || from(p.rotor_geom) || from(p.ring_geom)) return;
  if (std::abs(given - mu) <= 1e-9 + mjMINMU) return;
  refuse(pair_element(m, p),
         message("friction is {}, {} is {}; accepted: one value in both, or none here", given,
                 name.of(names::kOwnFriction), mu));
}

}  // namespace

std::string pair_element(const mjModel* m, const ContactPair& pair) {
  return message("<contact><pair geom1=\"{}\" geom2=\"{}\">",
                 m->names + m->name_geomadr[pair.rotor_geom],
                 m->names + m->name_geomadr[pair.ring_geom]);
}

// MuJoCo must not solve beside `rigid`, nor add friction beside `coulomb`.
void check_pair(const mjModel* m, const PairName& name, const ContactPair& p) {
  if (lies_across(m, p)) {
    refuse(message("<geom name=\"{}\">", m->names + m->name_geomadr[p.rotor_geom]),
           message("its axis stands across that of its ring, geom \"{}\", in qpos0; accepted: "
                   "tilted by less than 60 "
                   "degrees",
                   m->names + m->name_geomadr[p.ring_geom]));
  }
  const std::string element = pair_element(m, p);
  if (p.pair < 0) refuse(element, "missing");
  const double kept_out = m->pair_gap[p.pair] - m->pair_margin[p.pair];
  if (p.law == scene::ContactModel::kRigid) {
    refuse_mocap(m, p.rotor_geom);
    refuse_mocap(m, p.ring_geom);
    refuse_other_friction(m, name, p);
    if (kept_out >= 10.0 * p.contact.clearance) return;
    refuse(
        element,
        "contact model rigid keeps the contact from MuJoCo's solver: accepted: gap above margin by "
        "at least ten clearances");
  }
  if (m->pair_gap[p.pair] != 0.0) refuse(element, "accepted: gap=\"0\"");
  if (p.law == scene::ContactModel::kCoulomb) {
    if (m->pair_dim[p.pair] != 1) refuse(element, "contact model coulomb: accepted: condim=\"1\"");
  } else {
    check_cone(m, name, p);
  }
  check_bounce(m, name, p);
}

}  // namespace rotorub::plugin
