#include "plugin/contact/cone.h"

namespace rotorub::plugin {
// aref = -B v for a friction row; v is that of geom 2 against geom 1 along the frame's second axis:
// minus the slip of the rotor's surface where the rotor is geom 1 (and e_t turned where it is not).
void add_held_slip(double surface_speed, const mjModel* m, mjData* d, const mjContact& contact) {
  const double slip = -surface_speed;
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

// Of the edges of a pyramid in the tangential part of v.
void set_friction_reference(const mjModel* m, mjData* d, const mjContact& contact,
                            double reference) {
  const int first = contact.efc_address;
  if (!mj_isPyramidal(m)) {
    for (int row = first + 1; row < first + contact.dim; ++row)
      d->efc_aref[row] = -reference * d->efc_vel[row];
    return;
  }
  for (int edge = first; edge < first + 2 * (contact.dim - 1); edge += 2) {
    const double tangential = 0.5 * (d->efc_vel[edge] - d->efc_vel[edge + 1]);
    const double change = (d->efc_KBIP[4 * edge + 1] - reference) * tangential;
    d->efc_aref[edge] += change;
    d->efc_aref[edge + 1] -= change;
  }
}

}  // namespace rotorub::plugin
