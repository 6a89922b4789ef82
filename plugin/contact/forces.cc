#include "plugin/contact/forces.h"

#include <cmath>

#include "plugin/contact/annular.h"
#include "plugin/user_data.h"

namespace rotorub::plugin {
namespace {

ContactForces rigid_forces(const mjData* d) {
  const mjtNum* entry = d->userdata;
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

}  // namespace

ContactForces contact_forces(const Config& config, const mjData* d) {
  if (config.model.contact && config.contact == scene::ContactModel::kRigid) return rigid_forces(d);
  const mjContact* contact = config.model.contact ? find_contact(config, d) : nullptr;
  if (!contact) return {};
  const int row = contact->efc_address;
  ContactForces out;
  // Of own/own_contact.h it is known before MuJoCo's solver, which then finds the same.
  const bool told = config.contact == scene::ContactModel::kCoulomb && (config.own || config.general);
  out.normal = told ? d->userdata[kNormalForce] : d->efc_force[row];
  if (!(out.normal > 0.0)) return {};
  if (config.contact == scene::ContactModel::kCoulomb) {
    out.friction = d->userdata[kFrictionForce];
    out.mode = static_cast<Mode>(static_cast<int>(d->userdata[kMode]));
    return out;
  }
  // A force on geom 2 along the frame. Turning the frame turns e_t and the body that it acts on.
  out.friction = contact->dim >= 3 ? -d->efc_force[row + 1] : 0.0;
  // MuJoCo regularises: on the cone's surface it slides.
  const bool inside = std::abs(out.friction) < (1.0 - 1e-6) * contact->friction[0] * out.normal;
  out.mode = contact->dim >= 3 && inside ? Mode::kStick : Mode::kSlide;
  return out;
}

}  // namespace rotorub::plugin
