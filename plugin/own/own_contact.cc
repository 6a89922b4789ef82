#include "plugin/own/own_contact.h"

#include <cmath>

#include "native_model/contact/coulomb.h"
#include "plugin/contact/annular.h"
#include "plugin/contact/memory.h"
#include "plugin/contact/rigid_law.h"
#include "plugin/contact/smooth_force.h"
#include "plugin/own/own_space.h"
#include "plugin/passes.h"
#include "plugin/user_data.h"

namespace rotorub::plugin {
namespace {

void apply_rigid_law(const Config& config, const mjModel* m, mjData* d) {
  const ContactParameters& c = *config.model.contact;
  ContactMemory memory(d);
  update_smooth_force(m, d);
  OwnSpace space(config, m, d);
  space.solve();
  RigidStep step;
  step.h = m->opt.timestep;
  step.d = own_position(config, d);
  step.start = space.rates(d->qvel);
  step.free = step.start + step.h * space.response(d->qfrc_smooth);
  if (!contact_enabled(m) || !reaches_ring(step, c.clearance)) {
    memory.note({}, step.h);
    return;
  }
  step.was_in_contact = memory.was_in_contact();
  step.lasting_admittance = space.flexibility();
  step.impact_admittance = space.admittance();
  const RigidResult r = solve_rigid_step(step, c);
  memory.note(r, step.h);
  if (!(r.normal > 0.0)) return;
  const Eigen::Vector3d load =
      contact_load(r.e_r, c.radius, r.normal / step.h, r.friction / step.h);
  if (r.impact) {
    space.add_impact(load, d->qfrc_passive);
  } else {
    space.add_load(load, d->qfrc_passive);
  }
}

// MuJoCo's solver finds l = (aref - J a_smooth) / (J M^-1 J^T + R): the aref for l = normal.
double solver_reference(const mjModel* m, mjData* d, int row, const OwnSpace& space,
                        const Eigen::Vector3d& friction, const Delassus& own,
                        const Eigen::Vector2d& e_r, double normal) {
  const int mark = d->pstack;
  mjtNum* acceleration = mj_stackAlloc(d, m->nv);
  mju_copy(acceleration, d->qacc_smooth, m->nv);
  space.add_acceleration(friction, acceleration);
  const double smooth = -e_r.dot(space.rates(acceleration).head<2>());
  d->pstack = mark;
  // Open: well below, so that not even round-off leaves a force.
  if (normal <= 0.0) return smooth - (1.0 + std::abs(smooth));
  return smooth + (own.nn + d->efc_R[row]) * normal;
}

void apply_coulomb_law(const Config& config, const mjModel* m, mjData* d, const mjContact& con) {
  const ContactParameters& c = *config.model.contact;
  const double h = m->opt.timestep;
  const int row = con.efc_address;
  mj_fwdActuation(m, d);
  mj_fwdAcceleration(m, d);
  OwnSpace space(config, m, d);
  space.solve();
  const Eigen::Vector3d rates = space.rates(d->qvel), free = space.response(d->qfrc_smooth);
  const ContactPoint p = contact_kinematics(own_position(config, d), rates.head<2>(), rates.z(),
                                            c.radius, c.clearance);
  // Accelerations of gap and slip without contact force, and MuJoCo's a_ref with the gap rate of
  // the state's own time: see coulomb.cc.
  const double whirl = p.whirl_speed(), curvature = whirl * whirl / p.delta;
  const double gap_free = -p.e_r.dot(free.head<2>()) - curvature;
  const double slip_free =
      p.e_t().dot(free.head<2>()) + c.radius * free.z() + whirl / p.delta * p.gap_rate;
  const mjtNum* kbip = d->efc_KBIP + 4 * row;
  const double reference =
      -kbip[1] * (p.gap_rate + 0.5 * h * curvature) - kbip[0] * kbip[2] * p.gap;
  const bool lasts = d->userdata[kMode] != 0.0 && p.gap_rate <= -gap_free * h;
  CoulombSolution s;
  if (p.gap < 0.0 || lasts) {
    s = solve_coulomb(delassus(space.flexibility(), p.e_r, c.radius), gap_free - reference,
                      p.slip / h + slip_free, c.friction);
  }
  const bool sticks = s.contact_case == ContactCase::kStick;
  const Mode mode = s.normal <= 0.0 ? Mode::kFree : (sticks ? Mode::kStick : Mode::kSlide);
  d->userdata[kFrictionForce] = s.friction;
  d->userdata[kMode] = static_cast<double>(mode);
  const Eigen::Vector3d friction = contact_load(p.e_r, c.radius, 0.0, s.friction);
  d->efc_aref[row] = solver_reference(
      m, d, row, space, friction, delassus(space.admittance(), p.e_r, c.radius), p.e_r, s.normal);
  space.add_load(friction, d->qfrc_passive);
}

}  // namespace

void apply_own_contact(const Config& config, const mjModel* m, mjData* d) {
  if (config.contact == scene::ContactModel::kRigid) {
    apply_rigid_law(config, m, d);
    return;
  }
  d->userdata[kFrictionForce] = 0.0;
  const mjContact* contact = find_contact(config, d);
  if (!contact) {
    d->userdata[kMode] = 0.0;
  } else if (config.contact == scene::ContactModel::kCoulomb) {
    apply_coulomb_law(config, m, d, *contact);
  }
}

int collide_own(const Config& config, const mjData* d, mjContact* con, int g1, double margin) {
  const ContactParameters& c = *config.model.contact;
  const Eigen::Vector2d p = own_position(config, d);
  const double delta = p.norm();
  if (!(c.clearance - delta < margin) || delta <= kNoNormal) return 0;
  const Eigen::Vector2d e = p / delta;
  const mjtNum* axes = d->geom_xmat + 9 * config.ring_geom;
  const mjtNum* rotor = d->geom_xpos + 3 * config.rotor_geom;
  const double side = g1 == config.rotor_geom ? 1.0 : -1.0;
  con->dist = c.clearance - delta;
  for (int i = 0; i < 3; ++i) {
    const double normal = axes[3 * i] * e.x() + axes[3 * i + 1] * e.y();
    con->pos[i] = rotor[i] + c.radius * normal;
    con->frame[i] = side * normal;
    con->frame[3 + i] = side * (axes[3 * i + 1] * e.x() - axes[3 * i] * e.y());
    con->frame[6 + i] = axes[3 * i + 2];
  }
  return 1;
}

}  // namespace rotorub::plugin
