#include "plugin/own/pair_checks.h"

#include <cmath>

#include "mjcf/mujoco_version.h"
#include "mjcf/names.h"
#include "mjcf/soft_contact.h"
#include "native_model/scene/mujoco.h"
#include "plugin/model/later_attributes.h"
#include "plugin/model/mujoco_versions.h"

namespace rotorub::plugin {

std::string pair_element(const mjModel* m, const ContactPair& pair) {
  return message("<contact><pair geom1=\"{}\" geom2=\"{}\">",
                 m->names + m->name_geomadr[pair.rotor_geom],
                 m->names + m->name_geomadr[pair.ring_geom]);
}

namespace {

namespace names = mjcf_names;

// MuJoCo's restitution follows from solref; the one in <custom> must agree with it.
void check_bounce(const mjModel* m, const PairName& name, const ContactPair& p) {
  constexpr double kScatter = 0.03;  // MuJoCo's steps are not more accurate than this
  if (p.contact.tangential_restitution > 0.0) {
    refuse(
        own_element(m, name.of(names::kOwnTangential)),
        "contact models coulomb, cone and cone-coulomb have no tangential restitution; set 0, or "
        "use contact model rigid");
  }
  if (!own_number(m, name.of(names::kOwnRestitution))) return;
  const double wanted = p.contact.restitution;
  const mjtNum* solref = m->pair_solref + mjNREF * p.pair;
  const bool direct = solref[0] <= 0.0;
  const double zeta = direct ? -solref[1] / (2.0 * std::sqrt(-solref[0])) : solref[1];
  const double met = soft_restitution(zeta);
  if (std::abs(met - wanted) <= kScatter) return;
  const SoftContact soft = soft_contact(wanted, m->opt.timestep);
  refuse(
      pair_element(m, p),
      message("write solref=\"{} {}\" solimp=\"0.9999 0.9999 0.001\"; the present solref gives a "
              "restitution of {}, but {} is {}",
              -soft.stiffness, -soft.damping, std::round(1e3 * met) / 1e3,
              name.of(names::kOwnRestitution), wanted));
}

void check_cone(const mjModel* m, const PairName& name, const ContactPair& p, Refusals& refusals) {
  for (const char* force : {names::kNormalForce, names::kFrictionForce, names::kNormalForceScaled,
                            names::kFrictionForceScaled}) {
    const std::string sensor = name.of(force);
    const int id = mj_name2id(m, mjOBJ_SENSOR, sensor.c_str());
    if (id < 0 || m->sensor_type[id] != mjSENS_USER || m->sensor_needstage[id] == mjSTAGE_ACC)
      continue;
    refusals.attempt([&] {
      refuse(message("<user name=\"{}\">", sensor),
             "set needstage=\"acc\", because MuJoCo's solver finds the forces of contact models "
             "cone and "
             "cone-coulomb");
    });
  }
  refusals.attempt([&] {
    if (p.contact.friction.is_constant()) return;
    refuse(own_element(m, name.of(names::kOwnFriction)),
           "contact models cone and cone-coulomb have one coefficient for all slips; give a "
           "number, or use contact model rigid or coulomb");
  });
  const double mu = p.contact.friction.coefficient, given = m->pair_friction[5 * p.pair];
  refusals.attempt([&] {
    if (m->pair_dim[p.pair] < 3 || std::abs(given - mu) <= 1e-9 + mjMINMU) return;
    refuse(pair_element(m, p), message("friction is {}, but {} is {}; give one value in both",
                                       given, name.of(names::kOwnFriction), mu));
  });
  const double along = m->pair_friction[5 * p.pair + 1];
  refusals.attempt([&] {
    if (!p.axial || std::abs(along - mu) <= 1e-9 + mjMINMU) return;
    refuse(pair_element(m, p), message("friction along the axis, the second value, is {}, but {} "
                                       "is {}; give one value in all three",
                                       along, name.of(names::kOwnFriction), mu));
  });
}

// A mocap body moves without a velocity, so no impact with it can be computed.
void refuse_mocap(const mjModel* m, int geom) {
  const int root = m->body_rootid[m->geom_bodyid[geom]];
  if (m->body_mocapid[root] < 0) return;
  refuse(message("<body name=\"{}\" mocap=\"true\">", m->names + m->name_bodyadr[root]),
         message("moves geom \"{}\" of a contact without a velocity; for contact model rigid use a "
                 "body with joints, driven by actuators or by a weld to the mocap body",
                 m->names + m->name_geomadr[geom]));
}

// `rigid` takes its friction from <custom> alone. If the pair's friction equals that of one of its
// geoms, the user did not set it on the pair.
void refuse_other_friction(const mjModel* m, const PairName& name, const ContactPair& p) {
  const double mu = p.contact.friction.sticking(), given = m->pair_friction[5 * p.pair];
  const auto from = [&](int geom) { return given == m->geom_friction[3 * geom]; };
  if (m->pair_dim[p.pair] < 3 || from(p.rotor_geom) || from(p.ring_geom)) return;
  if (std::abs(given - mu) <= 1e-9 + mjMINMU) return;
  refuse(pair_element(m, p),
         message("friction is {}, but {} is {}; give one value in both, or none here", given,
                 name.of(names::kOwnFriction), mu));
}

// The <pair> as a generated file would contain it.
std::string pair_to_add(const mjModel* m, const ContactPair& p) {
  const ContactParameters& c = p.contact;
  const rotorub::ContactPair pair =
      contact_pair(p.contact_model, c.clearance, c.friction,
                   soft_contact(c.restitution, m->opt.timestep), built_for());
  std::string text = message("<pair geom1=\"{}\" geom2=\"{}\" condim=\"{}\"",
                             m->names + m->name_geomadr[p.rotor_geom],
                             m->names + m->name_geomadr[p.ring_geom], pair.condim);
  text += message(" margin=\"{}\" gap=\"{}\"", pair.margin, pair.gap);
  if (pair.condim > 1) text += message(" friction=\"{} {} 0 0 0\"", pair.friction, pair.friction);
  if (p.contact_model != scene::ContactModel::kRigid) {
    text += message(" solref=\"{} {}\" solimp=\"{} {} 0.001\"", -pair.soft.stiffness,
                    -pair.soft.damping, pair.soft.impedance, pair.soft.impedance);
  }
  return text + "/>";
}

}  // namespace

void check_solved_part(const mjModel* m, const ContactPair& p, Refusals& refusals) {
  const auto require = [&](bool holds, const char* reason) {
    refusals.attempt([&] {
      if (!holds) refuse(pair_element(m, p), reason);
    });
  };
  const double gap = m->pair_gap[p.pair];
  if (p.contact_model == scene::ContactModel::kRigid) {
    require(gap - m->pair_margin[p.pair] >= 10.0 * p.contact.clearance,
            "gap is too small: with contact model rigid MuJoCo's solver must not see the contact; "
            "set gap at least ten clearances above margin");
    return;
  }
  const int condim = m->pair_dim[p.pair];
  require(gap == 0.0 || p.further, "contact models coulomb, cone and cone-coulomb need gap=\"0\"");
  if (p.contact_model == scene::ContactModel::kCoulomb) {
    require(condim == 1, "contact model coulomb needs condim=\"1\"");
  } else {
    require(condim >= 3 || !(p.contact.friction.coefficient > 0.0),
            "contact models cone and cone-coulomb with friction need condim=\"3\" or more");
  }
}

void check_pair(const mjModel* m, const PairName& name, const ContactPair& p, Refusals& refusals) {
  const std::string element = pair_element(m, p);
  const auto check = [&refusals](auto action) { refusals.attempt(action); };
  if (p.pair < 0) {
    check([&] { refuse(element, message("missing; add {} in <contact>", pair_to_add(m, p))); });
    return;
  }
  check([&] {
    const int pairs = count_pairs(m, p.rotor_geom, p.ring_geom);
    if (pairs > 1) refuse(element, message("appears {} times; keep one", pairs));
  });
  check([&] { check_surface(m, p); });
  check_solved_part(m, p, refusals);
  if (p.contact_model == scene::ContactModel::kRigid) {
    check([&] { refuse_mocap(m, p.rotor_geom); });
    check([&] { refuse_mocap(m, p.ring_geom); });
    check([&] { refuse_other_friction(m, name, p); });
    return;
  }
  if (p.contact_model != scene::ContactModel::kCoulomb) check_cone(m, name, p, refusals);
  check([&] { check_bounce(m, name, p); });
}

}  // namespace rotorub::plugin
