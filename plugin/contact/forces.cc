#include "plugin/contact/forces.h"

#include <cmath>

#include "plugin/contact/annular.h"
#include "plugin/user_data.h"

namespace rotorub::plugin {
namespace {

ContactForces rigid_forces(const mjtNum* entry) {
  ContactForces out;
  out.normal = entry[kNormalForce];
  out.friction = entry[kFrictionForce];
  out.mode = static_cast<Mode>(static_cast<int>(entry[kMode]));
  out.status = static_cast<Status>(static_cast<int>(entry[kContactStatus]));
  out.impact = entry[kImpact] != 0.0;
  if (!out.impact) return out;
  out.impact_time = entry[kImpactTime];
  out.gap_rate_before = entry[kGapRateBefore];
  out.gap_rate_after = entry[kGapRateAfter];
  out.slip_before = entry[kSlipBefore];
  out.slip_after = entry[kSlipAfter];
  return out;
}

// Of a soft contact. Where `told`, it is known before MuJoCo's solver, which then finds the same.
ContactForces soft_forces(scene::ContactModel law, const mjContact* contact, const mjtNum* entry,
                          bool told, const mjData* d) {
  if (!contact) return {};
  const int row = contact->efc_address;
  ContactForces out;
  out.normal = told ? entry[kNormalForce] : d->efc_force[row];
  if (!(out.normal > 0.0)) return {};
  if (law == scene::ContactModel::kCoulomb) {
    out.friction = entry[kFrictionForce];
    out.mode = static_cast<Mode>(static_cast<int>(entry[kMode]));
    return out;
  }
  // A force on geom 2 along the frame. Turning the frame turns e_t and the body that it acts on.
  out.friction = contact->dim >= 3 ? -d->efc_force[row + 1] : 0.0;
  // MuJoCo regularises: on the cone's surface it slides.
  const bool inside = std::abs(out.friction) < (1.0 - 1e-6) * contact->friction[0] * out.normal;
  out.mode = contact->dim >= 3 && inside ? Mode::kStick : Mode::kSlide;
  return out;
}

}  // namespace

ContactForces contact_forces(const Config& config, const mjData* d) {
  if (!config.pairs.empty()) return contact_forces(config.pairs.front(), d);
  if (!config.model.contact) return {};
  if (config.contact == scene::ContactModel::kRigid) return rigid_forces(d->userdata);
  const mjContact* contact = find_contact(config.rotor_geom, config.ring_geom, d);
  return soft_forces(config.contact, contact, d->userdata, false, d);
}

ContactForces contact_forces(const OwnPair& pair, const mjData* d) {
  const mjtNum* entry = d->userdata + pair.data;
  if (pair.law == scene::ContactModel::kRigid) return rigid_forces(entry);
  const mjContact* contact = find_contact(pair.rotor_geom, pair.ring_geom, d);
  return soft_forces(pair.law, contact, entry, pair.law == scene::ContactModel::kCoulomb, d);
}

}  // namespace rotorub::plugin
