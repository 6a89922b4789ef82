#include "plugin/contact/segment_rigid.h"

#include "native_model/dynamics/dynamics.h"
#include "plugin/actuators.h"
#include "plugin/contact/rigid_step.h"
#include "plugin/contact/segment_space.h"

namespace rotorub::plugin {

void apply_segment_rigid(const Config& config, const mjModel* m, mjData* d,
                         const Coordinates& state) {
  const Model& model = config.model;
  compute_actuators(m, d);
  mj_fwdAcceleration(m, d);
  const StepMatrix matrix(m, d);
  const SegmentSpace space(config, m, d, matrix);
  RigidStep step;
  step.h = m->opt.timestep;
  step.d = separation(model, state.q());
  step.start = space.rates(d->qvel);
  apply_rigid_step(m, d, space, step, *model.contact);
}

}  // namespace rotorub::plugin
