#include "plugin/contact/cone.h"

namespace rotorub::plugin {

void apply_cone(const Config& config, mjData* d, const mjContact& contact) {
  const Model& model = config.model;
  if (model.layout.spin || contact.dim < 3) return;
  // aref = -B v for a friction row; v is that of geom 2 against geom 1 along the frame's second
  // axis: minus the slip of the rotor's surface where the rotor is geom 1 (and e_t turned where it
  // is not).
  const int row = contact.efc_address + 1;
  const double slip = -model.contact->radius * model.speed;
  d->efc_vel[row] += slip;
  d->efc_aref[row] -= d->efc_KBIP[4 * row + 1] * slip;
}

}  // namespace rotorub::plugin
