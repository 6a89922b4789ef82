#include "plugin/contact/contact_memory.h"

#include <algorithm>
#include <cmath>

#include "native_model/scene/mujoco.h"
#include "plugin/user_data.h"

namespace rotorub::plugin {
namespace {

ContactForces rigid_forces(const mjtNum* entry) {
  ContactForces out;
  out.normal = entry[kNormalForce];
  out.friction = entry[kFrictionForce];
  out.mode = static_cast<Mode>(static_cast<int>(entry[kMode]));
  out.status = EscapeGuard::status_in(entry[kContactStatus]);
  out.impact = entry[kImpact] != 0.0;
  if (!out.impact) return out;
  out.impact_time = entry[kImpactTime];
  out.gap_rate_before = entry[kGapRateBefore];
  out.gap_rate_after = entry[kGapRateAfter];
  out.slip_before = entry[kSlipBefore];
  out.slip_after = entry[kSlipAfter];
  return out;
}

// Within the surface of the cone, where MuJoCo's regularisation lets nothing stick in full: of its
// pyramid all edges of the two tangents then carry, of its ellipse |T| < mu N. force: along the
// contact's frame.
bool within_cone(const mjModel* m, const mjData* d, const mjContact& contact, const mjtNum* force) {
  const mjtNum* edges = d->efc_force + contact.efc_address;
  if (mj_isPyramidal(m)) return *std::min_element(edges, edges + 4) > 0.0;
  return std::hypot(force[1], force[2]) < (1.0 - 1e-6) * contact.friction[0] * force[0];
}

// Of a soft contact. Where `told`, it is known before MuJoCo's solver, which then finds the same.
ContactForces soft_forces(const mjModel* m, scene::ContactModel law, const mjContact* contact,
                          const mjtNum* entry, bool told, const mjData* d) {
  if (!contact) return {};
  // Along the contact's frame, whether the cone is a pyramid or an ellipse.
  mjtNum force[6];
  mj_contactForce(m, d, static_cast<int>(contact - d->contact), force);
  ContactForces out;
  out.normal = told ? entry[kNormalForce] : force[0];
  if (!(out.normal > 0.0)) return {};
  if (law == scene::ContactModel::kCoulomb) {
    out.friction = entry[kFrictionForce];
    out.mode = static_cast<Mode>(static_cast<int>(entry[kMode]));
    return out;
  }
  // A force on geom 2 along the frame. Turning the frame turns e_t and the body that it acts on.
  out.friction = -force[1];
  out.mode = contact->dim >= 3 && within_cone(m, d, *contact, force) ? Mode::kStick : Mode::kSlide;
  return out;
}

}  // namespace

const mjContact* find_contact(const ContactPair& pair, const mjData* d) {
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& c = d->contact[i];
    if (are_geoms(pair.rotor_geom, pair.ring_geom, c.geom1, c.geom2)) {
      return c.efc_address >= 0 ? &c : nullptr;
    }
  }
  return nullptr;
}

ContactForces contact_forces(const Config& config, const mjModel* m, const mjData* d) {
  return config.pairs.empty() ? ContactForces{} : contact_forces(config.pairs.front(), m, d);
}

ContactForces contact_forces(const ContactPair& pair, const mjModel* m, const mjData* d) {
  const mjtNum* entry = d->userdata + pair.data;
  if (pair.law == scene::ContactModel::kRigid || pair.beside) return rigid_forces(entry);
  const mjContact* contact = find_contact(pair, d);
  return soft_forces(m, pair.law, contact, entry, pair.law == scene::ContactModel::kCoulomb, d);
}

double compliant_force(const ContactPair& pair, const ContactPoint& point, mjtNum* entry) {
  const CompliantLaw& law = pair.contact.compliance;
  if (point.gap >= 0.0) {
    entry[kTouches] = 0.0;
    return 0.0;
  }
  if (entry[kTouches] == 0.0) entry[kTouchDamping] = law.a_of_touch(-point.gap_rate);
  entry[kTouches] = 1.0;
  return std::max(0.0, law.force(-point.gap, -point.gap_rate, entry[kTouchDamping]));
}

}  // namespace rotorub::plugin
