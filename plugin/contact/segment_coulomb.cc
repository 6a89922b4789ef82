#include "plugin/contact/segment_coulomb.h"

#include <algorithm>
#include <cmath>

#include "native_model/contact/coulomb.h"
#include "native_model/contact/rebound.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/trajectory/trajectory.h"
#include "plugin/actuators.h"
#include "plugin/contact/annular.h"
#include "plugin/contact/constraint_probe.h"
#include "plugin/contact/segment_space.h"
#include "plugin/user_data.h"

namespace rotorub::plugin {
namespace {

struct Rates {
  double gap, slip;  // m/s^2, without contact force
};

Rates free_rates(const ContactPoint& point, double radius, const Eigen::Vector3d& free) {
  const double whirl = point.whirl_speed();
  return {
      -point.e_r.dot(free.head<2>()) - whirl * whirl / point.delta,
      point.e_t().dot(free.head<2>()) + radius * free.z() + whirl / point.delta * point.gap_rate};
}

// MuJoCo's a_ref, with the gap rate of the state's own time (see coulomb.cc).
double reference(const mjData* d, int row, const ContactPoint& point, double h) {
  const double whirl = point.whirl_speed();
  const double gap_rate = point.gap_rate + 0.5 * h * whirl * whirl / point.delta;
  const mjtNum* kbip = d->efc_KBIP + 4 * row;
  return -kbip[1] * gap_rate - kbip[0] * kbip[2] * point.gap;
}

// The aref with which MuJoCo's solver, l = (aref - J a_smooth)/(J M^-1 J^T + R), finds `normal`
// beside the friction load.
double solver_reference(const mjModel* m, mjData* d, int row, const SegmentSpace& space,
                        const Eigen::Vector3d& friction, const ContactPoint& point, double normal) {
  const int nv = count(m->nv);
  StackFrame room(d);
  mjtNum* jacobian = room.numbers(nv);
  mjtNum* flexible = room.numbers(nv);
  if (mj_isSparse(m)) {
    std::fill_n(jacobian, nv, 0.0);
    space.add_load({-point.e_r.x(), -point.e_r.y(), 0.0}, jacobian);
  } else {
    std::copy_n(d->efc_J + row * nv, nv, jacobian);
  }
  mj_solveM(m, d, flexible, jacobian, 1);
  const double own = mju_dot(jacobian, flexible, nv);
  std::copy_n(d->qacc_smooth, nv, flexible);
  space.add_acceleration(friction, flexible);
  const double smooth = mju_dot(jacobian, flexible, nv);
  // Open: well below, so that not even round-off leaves a force.
  if (normal <= 0.0) return smooth - (1.0 + std::abs(smooth));
  return smooth + (own + d->efc_R[row]) * normal;
}

}  // namespace

void apply_segment_coulomb(const Config& config, const mjModel* m, mjData* d,
                           const mjContact& contact, const Coordinates& state) {
  const double h = m->opt.timestep, radius = config.model.contact->radius;
  const int row = contact.efc_address;
  compute_actuators(m, d);
  mj_fwdAcceleration(m, d);
  const StepMatrix matrix(m, d);
  const SegmentSpace space(config, m, d, matrix);
  // Once, not every step.
  if (d->userdata[kContactStatus] == 0.0 && constraints_couple(m, d, space, {&row, 1})) {
    warn_unknown(m, d, space);
    d->userdata[kContactStatus] = static_cast<double>(Status::kNoSolution);
  }
  const ContactPoint point = contact_point(config.model, state.q(), state.v());
  const Rates free = free_rates(point, radius, space.response(d->qfrc_smooth));

  // As on the modal chain: a rebound that the loads undo within the step is no flight.
  const bool lasts =
      d->userdata[kMode] != 0.0 && !flight_outlives(least_flight_unlocated(0.0) * h, point.gap_rate, -free.gap);
  CoulombSolution solution;
  if (point.gap < 0.0 || lasts) {
    solution = solve_coulomb(delassus(space.flexibility(), point.e_r, radius),
                             free.gap - reference(d, row, point, h), point.slip / h + free.slip,
                             friction_of(contact));
  }
  d->userdata[kFrictionForce] = solution.friction;
  d->userdata[kMode] = static_cast<double>(mode_of(solution));

  const Eigen::Vector3d friction = contact_load(point.e_r, radius, 0.0, solution.friction);
  d->efc_aref[row] = solver_reference(m, d, row, space, friction, point, solution.normal);
  space.add_load(friction, d->qfrc_passive);
}

}  // namespace rotorub::plugin
