#include "plugin/contact/rigid.h"

#include <algorithm>

#include "native_model/dynamics/dynamics.h"
#include "plugin/contact/memory.h"
#include "plugin/contact/rigid_law.h"
#include "plugin/contact/smooth_force.h"
#include "plugin/passive.h"

namespace rotorub::plugin {
namespace {

Eigen::Vector3d contact_rates(const Model& model, const double* v) {
  const Eigen::Vector2d relative = rotor_point(model, v) - stator_point(model, v);
  return {relative.x(), relative.y(), contact_spin(model, v)};
}

// v_k+1 without contact. MuJoCo solves with the diagonal H alone; where unbalance couples spin and
// bending, the passive force has what that leaves out.
void free_velocity(const Config& config, const mjModel* m, const mjData* d,
                   const Coordinates& state, const double* mass, double* v) {
  const double h = m->opt.timestep;
  for (int i = 0; i < config.model.nq(); ++i) {
    const int dof = config.dof_address[static_cast<std::size_t>(i)];
    v[i] = state.v()[i] + h * smooth_force(d, dof) / mass[i];
  }
}

// The force over the step that makes MuJoCo's velocities change as the impulses demand.
void add_force(const Config& config, const mjModel* m, mjData* d, const Coordinates& state,
               const double* mass, const RigidResult& r) {
  const Model& model = config.model;
  const int n = model.nq();
  const double h = m->opt.timestep;
  double load[kMaxCoordinates];
  std::fill_n(load, n, 0.0);
  add_contact_load(model, contact_load(r.e_r, model.contact->radius, r.normal / h, r.friction / h),
                   load);
  if (r.impact || model.coupled_mass()) {
    double change[kMaxCoordinates];
    if (r.impact) {
      solve_mass(model, d->time, state.q(), load, change);
    } else {
      solve_mass(model, mass, d->time, state.q(), load, change);
    }
    for (int i = 0; i < n; ++i) load[i] = mass[i] * change[i];
  }
  add_to_dofs(config, load, d->qfrc_passive);
}

}  // namespace

void refuse_runge_kutta(const mjModel* m) {
  if (m->opt.integrator == mjINT_RK4) {
    mju_error(
        "rotorub: <option integrator=\"RK4\">: contact model `rigid` gives its impulses once a "
        "step; "
        "accepted: Euler, implicit (or contact model coulomb or cone)");
  }
}

void apply_rigid(const Config& config, const mjModel* m, mjData* d, const Coordinates& state) {
  refuse_runge_kutta(m);
  const Model& model = config.model;
  ContactMemory memory(d);
  update_smooth_force(m, d);
  double mass[kMaxCoordinates], free[kMaxCoordinates];
  step_mass(config, m, mass);
  free_velocity(config, m, d, state, mass, free);

  RigidStep step;
  step.h = m->opt.timestep;
  step.d = rotor_point(model, state.q()) - stator_point(model, state.q());
  step.free = contact_rates(model, free);
  if (!reaches_ring(step, model.contact->clearance)) {
    memory.note({}, step.h);
    return;
  }
  step.start = contact_rates(model, state.v());
  step.was_in_contact = memory.was_in_contact();
  step.lasting_admittance = contact_admittance(model, mass, d->time, state.q());
  step.impact_admittance =
      model.coupled_mass() ? contact_admittance(model, d->time, state.q()) : model.admittance;
  const RigidResult r = solve_rigid_step(step, *model.contact);
  memory.note(r, step.h);
  if (r.normal > 0.0) add_force(config, m, d, state, mass, r);
}

}  // namespace rotorub::plugin
