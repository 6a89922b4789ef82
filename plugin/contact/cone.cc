#include "plugin/contact/cone.h"

namespace rotorub::plugin {

void apply_cone(const Config& config, const mjModel* m, mjData* d, const mjContact& contact) {
  const Model& model = config.model;
  if (model.layout.spin || contact.dim < 3) return;
  // aref = -B v for a friction row; v is that of geom 2 against geom 1 along the frame's second
  // axis: minus the slip of the rotor's surface where the rotor is geom 1 (and e_t turned where it
  // is not).
  const double slip = -model.contact->radius * model.speed;
  const auto add = [d](int row, double rate) {
    d->efc_vel[row] += rate;
    d->efc_aref[row] -= d->efc_KBIP[4 * row + 1] * rate;
  };
  const int first = contact.efc_address;
  if (!mj_isPyramidal(m)) {
    add(first + 1, slip);
    return;
  }
  // The two edges of the pyramid along it: v_N +- mu v_T.
  add(first, contact.friction[0] * slip);
  add(first + 1, -contact.friction[0] * slip);
}

}  // namespace rotorub::plugin
