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
  if (r.impact) {
    space.add_impact(load, d->qfrc_passive);
  } else {
    space.add_load(load, d->qfrc_passive);
  }
}

RigidResult solve(RigidStep& step, const ContactParameters& contact, const ContactSpace& space,
                  ContactMemory& memory, StepResponse* held) {
  if (!reaches_ring(step, contact.clearance)) return {};
  step.was_in_contact = memory.was_in_contact();
  step.lasting_admittance = space.flexibility();
  step.impact_admittance = space.admittance();
  return solve_rigid_step(step, contact, held);
}

RigidResult solve_held(const mjModel* m, mjData* d, const ContactSpace& space, RigidStep& step,
                       const ContactParameters& contact, ContactMemory& memory) {
  mj_fwdAcceleration(m, d);
  ConstraintProbe probe(m, d, space);
  ProbedStep held(probe, step.start, step.h);
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
                      const ContactParameters& contact) {
  ContactMemory memory(d);
  step.free = step.start + step.h * space.response(d->qfrc_smooth);
  RigidResult r;
  if (!contact_enabled(m)) {
    memory.note(r, step.h);
    return;
  }
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
