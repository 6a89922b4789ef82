#include "plugin/contact/coulomb.h"

#include <algorithm>

#include "native_model/contact/coulomb.h"
#include "native_model/system/dynamics.h"
#include "native_model/trajectory/trajectory.h"
#include "plugin/passive.h"
#include "plugin/user_data.h"

namespace rotorub::plugin {
namespace {

// Contact-space components (relative x, relative y, spin) of a vector of coordinate rates.
Eigen::Vector3d contact_rates(const Model& model, const double* v) {
  const Layout& l = model.layout;
  const Eigen::Vector2d relative = rotor_point(model, v) - stator_point(model, v);
  double spin = l.spin ? v[l.phi()] : 0.0;
  for (int k = 0; k < l.torsion; ++k) spin += model.torsion_contact[k] * v[l.theta() + k];
  return {relative.x(), relative.y(), spin};
}

// qacc_smooth and qfrc_smooth with the command just written.
void update_smooth_force(const mjModel* m, mjData* d) {
  mj_fwdActuation(m, d);
  mj_fwdAcceleration(m, d);
}

}  // namespace

void apply_coulomb(const Config& config, const mjModel* m, mjData* d, const mjContact& contact,
                   const Coordinates& state) {
  const Model& model = config.model;
  const int n = model.nq();
  const double h = m->opt.timestep, radius = model.contact->radius;
  const int row = contact.efc_address;
  const ContactPoint point = contact_point(model, state.q(), state.v());

  // Free motion of this step.
  update_smooth_force(m, d);
  double mass[kMaxCoordinates], f[kMaxCoordinates];
  step_mass(config, m, mass);
  for (int i = 0; i < n; ++i) {
    f[i] = d->qfrc_smooth[config.dof_address[static_cast<std::size_t>(i)]] / mass[i];
  }
  const Eigen::Vector3d free = contact_rates(model, f);
  const double whirl = point.whirl_speed();
  const double gap_acceleration = -point.e_r.dot(free.head<2>()) - whirl * whirl / point.delta;
  const double slip_acceleration =
      point.e_t().dot(free.head<2>()) + radius * free.z() + whirl / point.delta * point.gap_rate;

  const Eigen::Matrix3d admittance = contact_admittance(model, mass, d->time, state.q());
  const CoulombSolution solution =
      solve_coulomb(delassus(admittance, point.e_r, radius), gap_acceleration - d->efc_aref[row],
                    point.slip / h + slip_acceleration, contact.friction[0]);
  d->userdata[kFrictionForce] = solution.friction;
  const Mode mode = solution.normal <= 0.0                         ? Mode::kFree
                    : solution.contact_case == ContactCase::kStick ? Mode::kStick
                                                                   : Mode::kSlide;
  d->userdata[kMode] = static_cast<double>(mode);

  // Friction's load, and where unbalance couples spin and bending, what the integrator's diagonal
  // matrix does not pass on of the whole contact load p: H0 H(phi)^-1 p - p.
  double load[kMaxCoordinates];
  std::fill_n(load, n, 0.0);
  add_contact_load(model, contact_load(point.e_r, radius, 0.0, solution.friction), load);
  if (model.coupled_mass()) {
    std::fill_n(f, n, 0.0);
    add_contact_load(model, contact_load(point.e_r, radius, solution.normal, solution.friction), f);
    double a[kMaxCoordinates];
    solve_mass(model, mass, d->time, state.q(), f, a);
    for (int i = 0; i < n; ++i) load[i] += mass[i] * a[i] - f[i];
  }
  add_to_dofs(config, load, d->qfrc_passive);

  // MuJoCo's solver finds l = (aref - J M^-1 f_smooth) / (J M^-1 J^T + R).
  for (int i = 0; i < n; ++i) {
    const int dof = config.dof_address[static_cast<std::size_t>(i)];
    f[i] = (d->qfrc_smooth[dof] + load[i]) / model.mass[i];
  }
  const Eigen::Vector3d smooth = contact_rates(model, f);
  const Delassus diagonal = delassus(model.admittance, point.e_r, radius);
  if (solution.normal > 0.0) {
    d->efc_aref[row] =
        -point.e_r.dot(smooth.head<2>()) + (diagonal.nn + d->efc_R[row]) * solution.normal;
  } else {
    // Open: the reference that asks for no force.
    d->efc_aref[row] = std::min(d->efc_aref[row], -point.e_r.dot(smooth.head<2>()));
  }
}

}  // namespace rotorub::plugin
