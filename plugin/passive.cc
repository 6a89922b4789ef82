#include "plugin/passive.h"

#include <algorithm>
#include <cmath>

#include "native_model/dynamics/dynamics.h"
#include "plugin/mujoco_versions.h"

namespace rotorub::plugin {
namespace {

// f = -Omega G w, on the bending rows; 0 elsewhere.
void gyroscopic_force(const Model& model, double omega, const double* w, double* f) {
  const Layout& l = model.layout;
  std::fill_n(f, l.nq(), 0.0);
  model.gyroscopic.add(-omega, w + l.y(), f + l.x(), l.modes);
  model.gyroscopic.add_transposed(omega, w + l.x(), f + l.y(), l.modes);
}

// dv of (M(phi) + h D) dv = h (f - Omega G (v + dv/2)) by fixed-point iteration: each round gains
// the factor h Omega g / (2 m), far below 1 at any step that resolves the whirl.
void midpoint_velocity_change(const Config& config, const mjModel* m, const mjData* d,
                              const Coordinates& state, const double* mass, const double* f,
                              double* dv) {
  const Model& model = config.model;
  const int n = model.nq();
  const double h = m->opt.timestep, omega = spin_speed(model, state.v());
  double middle[kMaxCoordinates], force[kMaxCoordinates];
  std::fill_n(dv, n, 0.0);
  constexpr int kRounds = 60;
  for (int round = 0; round < kRounds; ++round) {
    for (int i = 0; i < n; ++i) middle[i] = state.v()[i] + 0.5 * dv[i];
    gyroscopic_force(model, omega, middle, force);
    for (int i = 0; i < n; ++i) force[i] = h * (force[i] + f[i]);
    solve_mass(model, mass, d->time, state.q(), force, force);
    double change = 0.0, size = 0.0;
    for (int i = 0; i < n; ++i) {
      change = std::max(change, std::abs(force[i] - dv[i]));
      size = std::max(size, std::abs(force[i]));
      dv[i] = force[i];
    }
    if (!(change > 1e-15 * size) || model.gyroscopic.absent()) return;
  }
}

}  // namespace

void step_mass(const Config& config, const mjModel* m, double* diagonal) {
  const Model& model = config.model;
  const double h = damped_step(m);
  for (int i = 0; i < model.nq(); ++i) diagonal[i] = model.mass[i] + h * model.damping[i];
}

void add_passive_force(const Config& config, const mjModel* m, mjData* d,
                       const Coordinates& state) {
  const Model& model = config.model;
  const int n = model.nq();
  double f[kMaxCoordinates];
  const bool rk4 = m->opt.integrator == mjINT_RK4;
  if (rk4 || (model.gyroscopic.absent() && !model.coupled_mass())) {
    coupling_force(model, d->time, state.q(), state.v(), f);
    add_to_dofs(config, f, d->qfrc_passive);
    return;
  }
  // All that is known of the step's force, then the dv it shall give, then the force that gives
  // it in MuJoCo.
  double mass[kMaxCoordinates], dv[kMaxCoordinates];
  step_mass(config, m, mass);
  load_force(model, d->time, state.q(), state.v(), f);
  for (int i = 0; i < n; ++i) {
    const int dof = config.dof_address[static_cast<std::size_t>(i)];
    f[i] += d->qfrc_passive[dof] + d->qfrc_applied[dof];
  }
  midpoint_velocity_change(config, m, d, state, mass, f, dv);
  const double h = m->opt.timestep;
  for (int i = 0; i < n; ++i) {
    const int dof = config.dof_address[static_cast<std::size_t>(i)];
    d->qfrc_passive[dof] = mass[i] * dv[i] / h - d->qfrc_applied[dof];
  }
}

}  // namespace rotorub::plugin
