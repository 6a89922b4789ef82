#include "plugin/contact/touching_pair.h"

namespace rotorub::plugin {

TouchingPair touching_pair(const ContactPair& pair, const ContactPlace& place,
                           const ContactSpace& space, const ContactSpace* axial, const mjModel* m,
                           const mjData* d, int row) {
  const double h = m->opt.timestep;
  TouchingPair s;
  s.pair = &pair;
  s.space = &space;
  s.axial = axial;
  s.row = row;
  Eigen::Vector3d rates = space.rates(d->qvel);
  rates.z() += pair.held_spin;
  s.point = contact_kinematics(place.d, rates.head<2>(), rates.z(), pair.contact.radius,
                               pair.contact.clearance);
  const ContactPoint& p = s.point;
  const double whirl = p.whirl_speed();
  const Eigen::Vector2d turning =
      pair.on_chain ? Eigen::Vector2d(0.0, 0.0) : turning_of(pair, place, m, d);
  const double whirling = whirl * whirl / p.delta;
  s.curvature = whirling + p.e_r.dot(turning);
  // MuJoCo's a_ref with the gap rate of the state's own time: that of a semi-implicit step is of
  // half a step ago.
  const mjtNum* kbip = d->efc_KBIP + 4 * row;
  const double reference =
      -kbip[1] * (p.gap_rate + 0.5 * h * s.curvature) - kbip[0] * kbip[2] * p.gap;
  s.base = {-s.curvature - reference,
            p.slip / h + whirl / p.delta * p.gap_rate + p.e_t().dot(turning),
            axial ? s.column().dot(axial->rates(d->qvel)) / h : 0.0};
  return s;
}

}  // namespace rotorub::plugin
