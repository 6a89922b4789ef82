#include "plugin/contact/segment_rigid.h"

#include "native_model/dynamics/dynamics.h"
#include "plugin/contact/memory.h"
#include "plugin/contact/rigid_law.h"
#include "plugin/contact/segment_space.h"
#include "plugin/passes.h"

namespace rotorub::plugin {

void apply_segment_rigid(const Config& config, const mjModel* m, mjData* d,
                         const Coordinates& state) {
  const Model& model = config.model;
  ContactMemory memory(d);
  if (m->nu > 0) mj_fwdActuation(m, d);
  mj_fwdAcceleration(m, d);
  const SegmentSpace space(config, m, d);

  RigidStep step;
  step.h = m->opt.timestep;
  step.d = rotor_point(model, state.q()) - stator_point(model, state.q());
  step.start = space.rates(d->qvel);
  step.free = step.start + step.h * space.response(d->qfrc_smooth);
  if (!contact_enabled(m) || !reaches_ring(step, model.contact->clearance)) {
    memory.note({}, step.h);
    return;
  }
  step.was_in_contact = memory.was_in_contact();
  step.lasting_admittance = space.flexibility();
  step.impact_admittance = space.admittance();
  const RigidResult r = solve_rigid_step(step, *model.contact);
  memory.note(r, step.h);
  if (!(r.normal > 0.0)) return;
  const Eigen::Vector3d load =
      contact_load(r.e_r, model.contact->radius, r.normal / step.h, r.friction / step.h);
  if (r.impact) {
    space.add_impact(load, d->qfrc_passive);
  } else {
    space.add_load(load, d->qfrc_passive);
  }
}

}  // namespace rotorub::plugin
