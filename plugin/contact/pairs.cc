#include "plugin/contact/pairs.h"

#include <vector>

#include "native_model/contact/kinematics.h"
#include "native_model/scene/mujoco.h"
#include "plugin/contact/cone.h"
#include "plugin/contact/contact_memory.h"
#include "plugin/contact/coulomb.h"
#include "plugin/contact/relative_motion.h"
#include "plugin/contact/rigid.h"

namespace rotorub::plugin {
namespace {

// Calls action(contact) for each contact of two geoms that MuJoCo solves.
template <typename Action>
void for_each_solved(const mjData* d, int geom1, int geom2, Action action) {
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& c = d->contact[i];
    if (c.efc_address >= 0 && are_geoms(geom1, geom2, c.geom1, c.geom2)) action(c);
  }
}

// Compliant contact: a_ref = R N in the normal row, because MuJoCo's f = (a_ref - a) / R tends to N
// as its impedance d tends to 0. Friction stops the slip within the step, as far as the cone
// allows: a_ref = -v (1 - d) / (d h).
void give_way(const ContactPair& pair, const ContactPoint& point, const mjModel* m, mjData* d,
              const mjContact& contact) {
  const double force = compliant_force(pair, point, m, d);
  const int row = contact.efc_address;
  const double impedance = m->pair_solimp[mjNIMP * pair.pair];
  set_friction_reference(m, d, contact, (1.0 - impedance) / (impedance * m->opt.timestep));
  d->efc_aref[row] = d->efc_R[row] * force;
}

void apply_cones(const Config& config, const mjModel* m, mjData* d, PassMotion& motion) {
  const double halves_slip = 0.5 / m->opt.timestep;  // 1/s, B_t of corrected contacts
  // Kept between the passes, so that its memory is allocated only once.
  static thread_local std::vector<SlidingContact> corrected;
  corrected.clear();
  for (const int pair : config.corrected_pairs) {
    for_each_solved(d, m->pair_geom1[pair], m->pair_geom2[pair], [&](const mjContact& c) {
      set_friction_reference(m, d, c, halves_slip);
      corrected.push_back({&c, {}});
    });
  }
  for (const ContactPair& pair : config.pairs) {
    if (!scene::is_cone(pair.contact_model)) continue;
    for_each_solved(d, pair.rotor_geom, pair.ring_geom, [&](const mjContact& c) {
      if (pair.prescribed_spin != 0.0 && c.dim >= 3)
        add_prescribed_slip(pair.contact.radius * pair.prescribed_spin, m, d, c);
      if (pair.contact.is_compliant()) {
        give_way(pair, motion.of(pair).point(), m, d, c);
        corrected.push_back({&c, {}});
      } else if (pair.contact_model == scene::ContactModel::kConeCoulomb) {
        set_friction_reference(m, d, c, halves_slip);
        const ContactPoint point = motion.of(pair).point();
        corrected.push_back({&c, point.whirl_speed() * point.whirl_speed() / point.delta});
      } else if (pair.friction_reference > 0.0) {
        set_friction_reference(m, d, c, pair.friction_reference);
      }
    });
  }
  correct_cones(m, d, corrected);
}

}  // namespace

void apply_contacts(const Config& config, const mjModel* m, mjData* d, PassMotion& motion) {
  // The soft contacts come first, because `rigid` tries its loads on MuJoCo's solver, which
  // includes them like any other contact.
  if (config.has_soft()) apply_coulomb(config, m, d, motion);
  apply_cones(config, m, d, motion);
  if (config.has_rigid()) apply_rigid(config, m, d, motion);
}

int collide_exactly(const ContactPair& pair, const mjData* d, CollisionContact* con, int g1,
                    double margin) {
  const ContactParameters& c = pair.contact;
  const ContactPlace place = contact_place(pair, d);
  const double delta = place.d.norm();
  if (!(c.clearance - delta < margin) || delta <= kNoNormal) return 0;
  if (!face_each_other(pair, place)) return 0;
  const Eigen::Vector2d e = place.d / delta;
  const mjtNum* axes = place.axes;
  const mjtNum* rotor = d->geom_xpos + 3 * pair.rotor_geom;
  const double side = g1 == pair.rotor_geom ? 1.0 : -1.0;
  con->dist = c.clearance - delta;
  double normal[3], tangent[3];
  for (int i = 0; i < 3; ++i) {
    const double outward = axes[3 * i] * e.x() + axes[3 * i + 1] * e.y();
    con->pos[i] = rotor[i] + c.radius * outward;
    normal[i] = side * outward;
    tangent[i] = side * (axes[3 * i + 1] * e.x() - axes[3 * i] * e.y());
  }
  set_frame(con, normal, tangent, {axes[2], axes[5], axes[8]});
  return 1;
}

}  // namespace rotorub::plugin
