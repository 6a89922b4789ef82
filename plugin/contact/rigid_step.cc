#include "plugin/contact/rigid_step.h"

#include "native_model/contact/kinematics.h"
#include "plugin/contact/constraint_probe.h"
#include "plugin/contact/memory.h"
#include "plugin/passes.h"

namespace rotorub::plugin {
namespace {

void add_impulses(const RigidResult& r, const RigidStep& step, const ContactParameters& contact,
                  const ContactSpace& space, mjData* d) {
  if (!(r.normal > 0.0)) return;
  const Eigen::Vector3d load =
      contact_load(r.e_r, contact.radius, r.normal / step.h, r.friction / step.h);
  space.add(load, r.impact, d->qfrc_passive);
}

// A rotor that can neither slip nor spin (one slide) has G_TT = 0: a trace of it, that of a spin
// that nothing is asked of, leaves the 2x2 problem solvable.
Eigen::Matrix3d with_spin(Eigen::Matrix3d admittance, double radius) {
  constexpr double kTrace = 1e-12;
  if (admittance(2, 2) == 0.0) {
    admittance(2, 2) = kTrace * (admittance(0, 0) + admittance(1, 1)) / (radius * radius);
  }
  return admittance;
}

// False: no impulse of the contact opens the gap. Nothing that moves is beside the normal.
bool can_open(const RigidStep& step, double clearance) {
  const Eigen::Vector2d e_r = contact_normal(step, clearance);
  const Eigen::Matrix2d g = step.lasting_admittance.topLeftCorner<2, 2>();
  return e_r.dot(g * e_r) > 1e-12 * g.trace();
}

RigidResult solve(RigidStep& step, const ContactParameters& contact, const ContactSpace& space,
                  ContactMemory& memory, StepResponse* held) {
  if (!reaches_ring(step, contact.clearance)) return {};
  step.was_in_contact = memory.was_in_contact(step.d.norm(), contact.clearance);
  step.lasting_admittance = with_spin(space.flexibility(), contact.radius);
  // Only what was open has an impact.
  if (!step.was_in_contact) step.impact_admittance = with_spin(space.admittance(), contact.radius);
  if (!can_open(step, contact.clearance)) {
    RigidResult none;
    none.status = Status::kNoSolution;
    return none;
  }
  return solve_rigid_step(step, contact, held);
}

RigidResult solve_held(const mjModel* m, mjData* d, const ContactSpace& space, RigidStep& step,
                       const ContactParameters& contact, ContactMemory& memory) {
  mj_fwdAcceleration(m, d);
  ConstraintProbe probe(m, d);
  ProbedStep held(probe, space, step.start, step.h);
  step.free = held.end(Eigen::Vector3d::Zero(), false);
  const RigidResult r = solve(step, contact, space, memory, &held);
  if (r.normal > 0.0) {
    held.end(contact_load(r.e_r, contact.radius, r.normal, r.friction), r.impact);
    probe.keep();
  }
  return r;
}

}  // namespace

void apply_rigid_step(const mjModel* m, mjData* d, const ContactSpace& space, RigidStep& step,
                      const ContactParameters& contact, int data) {
  ContactMemory memory(d, data, step.h);
  step.free = step.start + step.h * space.response(d->qfrc_smooth);
  RigidResult r;
  if (!contact_enabled(m)) {
    memory.note(r, step.h);
    return;
  }
  memory.watch(step.d.norm(), contact);
  if (!constraints_couple(m, d, space)) {
    r = solve(step, contact, space, memory, nullptr);
  } else {
    r = solve_held(m, d, space, step, contact, memory);
    if (!r.converged && !memory.warned()) warn_unsolved(m, d, space);
  }
  memory.note(r, step.h);
  add_impulses(r, step, contact, space, d);
}

}  // namespace rotorub::plugin
