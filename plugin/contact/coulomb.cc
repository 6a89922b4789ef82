#include "plugin/contact/coulomb.h"

#include <algorithm>
#include <cmath>

#include "native_model/contact/coulomb.h"
#include "native_model/contact/rebound.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/trajectory/trajectory.h"
#include "plugin/actuators.h"
#include "plugin/contact/annular.h"
#include "plugin/passive.h"
#include "plugin/user_data.h"

namespace rotorub::plugin {
namespace {

// Contact-space components (relative x, relative y, spin) of a vector of coordinate rates.
Eigen::Vector3d contact_rates(const Model& model, const double* v) {
  return contact_acceleration(model, v);
}

// qacc_smooth and qfrc_smooth with the command just written.
void update_smooth_force(const mjModel* m, mjData* d) {
  compute_actuators(m, d);
  mj_fwdAcceleration(m, d);
}

// One contact in the acceleration space of this step, seen from its free motion.
struct Problem {
  ContactPoint point;
  double gap_acceleration;       // m/s^2, gddot_N without contact force
  double slip_acceleration;      // m/s^2, of gdot_T likewise
  double reference;              // m/s^2, a_ref
  double mass[kMaxCoordinates];  // diagonal of M + h D
};

void state_problem(const Config& config, const mjModel* m, const mjData* d, int row,
                   const Coordinates& state, Problem& p) {
  const Model& model = config.model;
  const double h = m->opt.timestep, radius = model.contact->radius;
  p.point = contact_point(model, state.q(), state.v());
  step_mass(config, m, p.mass);
  double a[kMaxCoordinates];
  for (int i = 0; i < model.nq(); ++i) {
    a[i] = d->qfrc_smooth[config.dof_address[static_cast<std::size_t>(i)]] / p.mass[i];
  }
  const Eigen::Vector3d free = contact_rates(model, a);
  const double whirl = p.point.whirl_speed();
  const double curvature = whirl * whirl / p.point.delta;  // m/s^2
  p.gap_acceleration = -p.point.e_r.dot(free.head<2>()) - curvature;
  p.slip_acceleration = p.point.e_t().dot(free.head<2>()) + radius * free.z() +
                        whirl / p.point.delta * p.point.gap_rate;
  // The velocity of a semi-implicit step is that of half a step ago: on a circle it points outward
  // by h/2 v_t^2 / delta, which is no closing of the gap.
  const double gap_rate = p.point.gap_rate + 0.5 * h * curvature;
  const mjtNum* kbip = d->efc_KBIP + 4 * row;  // stiffness, damping, impedance
  p.reference = -kbip[1] * gap_rate - kbip[0] * kbip[2] * p.point.gap;
}

// A gap that is open, though by less than the margin, is contact only where contact lasts: a
// rebound that the loads would undo within the step is no flight. Without this a permanent rub
// would lose its force each time the gap is a nanometre above 0.
bool in_contact(const mjData* d, const Problem& p, double h) {
  if (p.point.gap < 0.0) return true;
  return d->userdata[kMode] != 0.0 &&
         !flight_outlives(least_flight_unlocated(0.0) * h, p.point.gap_rate, -p.gap_acceleration);
}

// Friction's load, and where unbalance couples spin and bending, what the integrator's diagonal
// matrix H0 does not pass on of the whole contact load p: H0 H(phi)^-1 p - p.
void side_load(const Config& config, const mjData* d, const Coordinates& state, const Problem& p,
               const CoulombSolution& solution, double* load) {
  const Model& model = config.model;
  const int n = model.nq();
  const double radius = model.contact->radius;
  std::fill_n(load, n, 0.0);
  add_contact_load(model, contact_load(p.point.e_r, radius, 0.0, solution.friction), load);
  if (!model.coupled_mass()) return;
  double whole[kMaxCoordinates], a[kMaxCoordinates];
  std::fill_n(whole, n, 0.0);
  add_contact_load(model, contact_load(p.point.e_r, radius, solution.normal, solution.friction),
                   whole);
  solve_mass(model, p.mass, d->time, state.q(), whole, a);
  for (int i = 0; i < n; ++i) load[i] += p.mass[i] * a[i] - whole[i];
}

// MuJoCo's solver finds l = (aref - J M^-1 f_smooth) / (J M^-1 J^T + R): the aref for l = normal.
double solver_reference(const Config& config, const mjData* d, int row, const Problem& p,
                        const double* load, double normal) {
  const Model& model = config.model;
  double a[kMaxCoordinates];
  for (int i = 0; i < model.nq(); ++i) {
    const int dof = config.dof_address[static_cast<std::size_t>(i)];
    a[i] = (d->qfrc_smooth[dof] + load[i]) / model.mass[i];
  }
  const double smooth = -p.point.e_r.dot(contact_rates(model, a).head<2>());
  // Open: well below, so that not even round-off leaves a force.
  if (normal <= 0.0) return smooth - (1.0 + std::abs(smooth));
  const Delassus g = delassus(model.admittance, p.point.e_r, model.contact->radius);
  return smooth + (g.nn + d->efc_R[row]) * normal;
}

}  // namespace

void apply_coulomb(const Config& config, const mjModel* m, mjData* d, const mjContact& contact,
                   const Coordinates& state) {
  const Model& model = config.model;
  const double h = m->opt.timestep;
  const int row = contact.efc_address;
  update_smooth_force(m, d);
  Problem p;
  state_problem(config, m, d, row, state, p);

  CoulombSolution solution;
  if (in_contact(d, p, h)) {
    const Eigen::Matrix3d admittance = contact_admittance(model, p.mass, d->time, state.q());
    solution = solve_coulomb(delassus(admittance, p.point.e_r, model.contact->radius),
                             p.gap_acceleration - p.reference,
                             p.point.slip / h + p.slip_acceleration, friction_of(contact));
  }
  d->userdata[kFrictionForce] = solution.friction;
  d->userdata[kMode] = static_cast<double>(mode_of(solution));

  double load[kMaxCoordinates];
  side_load(config, d, state, p, solution, load);
  add_to_dofs(config, load, d->qfrc_passive);
  d->efc_aref[row] = solver_reference(config, d, row, p, load, solution.normal);
}

}  // namespace rotorub::plugin
