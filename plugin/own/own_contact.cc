#include "plugin/own/own_contact.h"

#include <cmath>

#include "native_model/contact/coulomb.h"
#include "plugin/contact/annular.h"
#include "plugin/contact/constrained_law.h"
#include "plugin/contact/constraint_probe.h"
#include "plugin/contact/memory.h"
#include "plugin/contact/rigid_step.h"
#include "plugin/contact/smooth_force.h"
#include "plugin/own/own_space.h"
#include "plugin/own/reach.h"
#include "plugin/user_data.h"

namespace rotorub::plugin {
namespace {

void apply_rigid_law(const Config& config, const mjModel* m, mjData* d) {
  const ContactParameters& c = *config.model.contact;
  update_smooth_force(m, d);
  ContactMemory memory(d);
  if (!face_each_other(config, d) ||
      (!memory.was_in_contact() && !may_reach_ring(config, m, d))) {
    memory.note({}, m->opt.timestep);
    return;
  }
  OwnSpace space(config, m, d);
  space.solve();
  RigidStep step;
  step.h = m->opt.timestep;
  step.d = own_position(config, d);
  step.start = space.rates(d->qvel);
  step.start.z() += held_spin(config);
  apply_rigid_step(m, d, space, step, c);
}

// Accelerations of the contact under a force, with what else makes up y of coulomb.h.
class ForceResponse final : public ContactResponse {
 public:
  ForceResponse(ConstraintProbe& probe, const ContactPoint& point, double radius, double slip)
      : probe_(probe), point_(point), radius_(radius), slip_(slip) {}
  Eigen::Vector2d at(const Eigen::Vector2d& p) override {
    const Eigen::Vector3d a =
        probe_.acceleration(contact_load(point_.e_r, radius_, p.x(), p.y()), false);
    return {-point_.e_r.dot(a.head<2>()),
            slip_ + point_.e_t().dot(a.head<2>()) + radius_ * a.z()};
  }
  double accuracy() const override { return probe_.accuracy(); }

 private:
  ConstraintProbe& probe_;
  const ContactPoint& point_;
  double radius_, slip_;
};

// One contact in accelerations: see coulomb.h.
struct CoulombStep {
  ContactPoint point;
  double radius, friction, h;
  double curvature;  // m/s^2
  double slip;       // m/s^2, y_T without any force
  double reference;  // m/s^2, MuJoCo's a_ref with the gap rate of the state's own time
  bool before;       // contact in the pass before
};

CoulombStep coulomb_step(const Config& config, const mjModel* m, const mjData* d, int row,
                         const Eigen::Vector3d& rates) {
  const ContactParameters& c = *config.model.contact;
  CoulombStep s;
  s.point = contact_kinematics(own_position(config, d), rates.head<2>(), rates.z(), c.radius,
                               c.clearance);
  s.radius = c.radius;
  s.friction = c.friction;
  s.h = m->opt.timestep;
  const ContactPoint& p = s.point;
  const double whirl = p.whirl_speed();
  s.curvature = whirl * whirl / p.delta;
  s.slip = p.slip / s.h + whirl / p.delta * p.gap_rate;
  const mjtNum* kbip = d->efc_KBIP + 4 * row;
  s.reference = -kbip[1] * (p.gap_rate + 0.5 * s.h * s.curvature) - kbip[0] * kbip[2] * p.gap;
  s.before = d->userdata[kMode] != 0.0;
  return s;
}

// A rebound that the loads undo within the step is no flight.
bool touches(const CoulombStep& s, double gap_acceleration) {
  const bool lasts = s.before && s.point.gap_rate <= -(gap_acceleration - s.curvature) * s.h;
  return s.point.gap < 0.0 || lasts;
}

CoulombSolution solve_free(const CoulombStep& s, const OwnSpace& space, const mjData* d) {
  const Eigen::Vector3d free = space.response(d->qfrc_smooth);
  const double gap = -s.point.e_r.dot(free.head<2>());
  if (!touches(s, gap)) return {};
  return solve_coulomb(delassus(space.flexibility(), s.point.e_r, s.radius),
                       gap - s.curvature - s.reference,
                       s.slip + s.point.e_t().dot(free.head<2>()) + s.radius * free.z(),
                       s.friction);
}

// Open: well below, so that not even round-off leaves a force.
double open_reference(double acceleration) { return acceleration - (1.0 + std::abs(acceleration)); }

// MuJoCo's solver finds l = (aref - J a_smooth) / (J M^-1 J^T + R): the aref for l = normal.
double solver_reference(const mjModel* m, mjData* d, int row, const OwnSpace& space,
                        const Eigen::Vector3d& friction, const CoulombStep& s, double normal) {
  StackFrame room(d);
  mjtNum* acceleration = room.numbers(count(m->nv));
  mju_copy(acceleration, d->qacc_smooth, count(m->nv));
  space.add_acceleration(friction, acceleration);
  const double smooth = -s.point.e_r.dot(space.rates(acceleration).head<2>());
  if (normal <= 0.0) return open_reference(smooth);
  const Delassus own = delassus(space.admittance(), s.point.e_r, s.radius);
  return smooth + (own.nn + d->efc_R[row]) * normal;
}

// The same beside constraints: the contact's own row rests while the others are tried. What the
// solver finds then is J a = aref - R l.
CoulombSolution solve_beside_constraints(const mjModel* m, mjData* d, int row,
                                         const OwnSpace& space, const CoulombStep& s) {
  constexpr double kResting = -1e12;  // m/s^2
  d->efc_aref[row] = kResting;
  ConstraintProbe probe(m, d, space);
  ForceResponse response(probe, s.point, s.radius, s.slip);
  const Eigen::Vector2d free = response.at({0.0, 0.0});
  CoulombSolution out;
  if (touches(s, free.x())) {
    const ConstrainedContact found =
        solve_constrained(response, free, delassus(space.flexibility(), s.point.e_r, s.radius),
                          -s.curvature - s.reference, s.friction);
    if (!found.converged && d->userdata[kContactStatus] == 0.0) warn_unsolved(m, d, space);
    d->userdata[kContactStatus] = found.converged ? 0.0 : static_cast<double>(Status::kNoSolution);
    out.normal = found.p.x();
    out.friction = found.p.y();
    if (out.normal > 0.0) {
      const bool forward = found.y.y() > 0.0;
      out.contact_case = found.sticks ? ContactCase::kStick
                         : forward    ? ContactCase::kSlidePositive
                                      : ContactCase::kSlideNegative;
    }
  }
  response.at({out.normal, out.friction});
  const double found = -s.point.e_r.dot(space.rates(d->qacc).head<2>());
  if (out.normal > 0.0) probe.keep();
  d->efc_aref[row] =
      out.normal > 0.0 ? found + d->efc_R[row] * out.normal : open_reference(found);
  return out;
}

void apply_coulomb_law(const Config& config, const mjModel* m, mjData* d, const mjContact& con) {
  const int row = con.efc_address;
  mj_fwdActuation(m, d);
  mj_fwdAcceleration(m, d);
  OwnSpace space(config, m, d);
  space.solve();
  Eigen::Vector3d rates = space.rates(d->qvel);
  rates.z() += held_spin(config);
  const CoulombStep step = coulomb_step(config, m, d, row, rates);
  const bool beside = constraints_couple(m, d, space, row);
  const CoulombSolution s =
      beside ? solve_beside_constraints(m, d, row, space, step) : solve_free(step, space, d);
  const bool sticks = s.contact_case == ContactCase::kStick;
  const Mode mode = s.normal <= 0.0 ? Mode::kFree : (sticks ? Mode::kStick : Mode::kSlide);
  d->userdata[kNormalForce] = s.normal;
  d->userdata[kFrictionForce] = s.friction;
  d->userdata[kMode] = static_cast<double>(mode);
  const Eigen::Vector3d friction = contact_load(step.point.e_r, step.radius, 0.0, s.friction);
  if (!beside) d->efc_aref[row] = solver_reference(m, d, row, space, friction, step, s.normal);
  space.add_load(friction, d->qfrc_passive);
}

}  // namespace

void apply_own_contact(const Config& config, const mjModel* m, mjData* d) {
  if (config.contact == scene::ContactModel::kRigid) {
    apply_rigid_law(config, m, d);
    return;
  }
  d->userdata[kNormalForce] = 0.0;
  d->userdata[kFrictionForce] = 0.0;
  const mjContact* contact = find_contact(config, d);
  if (!contact) {
    d->userdata[kMode] = 0.0;
  } else if (config.contact == scene::ContactModel::kCoulomb) {
    apply_coulomb_law(config, m, d, *contact);
  }
}

int collide_own(const Config& config, const mjData* d, CollisionContact* con, int g1,
                double margin) {
  const ContactParameters& c = *config.model.contact;
  const Eigen::Vector2d p = own_position(config, d);
  const double delta = p.norm();
  if (!(c.clearance - delta < margin) || delta <= kNoNormal) return 0;
  if (!face_each_other(config, d)) return 0;
  const Eigen::Vector2d e = p / delta;
  const mjtNum* axes = d->geom_xmat + 9 * config.ring_geom;
  const mjtNum* rotor = d->geom_xpos + 3 * config.rotor_geom;
  const double side = g1 == config.rotor_geom ? 1.0 : -1.0;
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
