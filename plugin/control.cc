#include "plugin/control.h"

#include <limits>

#include "native_model/bearing/actuator_axes.h"
#include "native_model/control/sampling.h"
#include "native_model/system/actuation.h"
#include "native_model/system/dynamics.h"
#include "plugin/magnets.h"
#include "plugin/user_data.h"
#include "plugin/velocity_history.h"

namespace rotorub::plugin {
namespace {

// `rigid` meets the ring after the command of the same step has been written: the command knows it
// from the next step on, whether or not this step's forward pass is repeated.
double first_touch(const Config& config, const mjData* d) {
  const bool late = config.contact == scene::ContactModel::kRigid;
  const double touch = d->userdata[kFirstTouch];
  const bool known = d->userdata[kTouched] != 0.0 && !(late && touch >= d->time);
  return known ? touch : std::numeric_limits<double>::infinity();
}

}  // namespace

void note_first_touch(const Config& config, mjData* d, const Coordinates& state) {
  if (!config.model.contact || d->userdata[kTouched] != 0.0) return;
  if (config.contact == scene::ContactModel::kRigid) return;  // notes it itself
  if (contact_point(config.model, state.q(), state.v()).gap < 0.0) {
    d->userdata[kTouched] = 1.0;
    d->userdata[kFirstTouch] = d->time;
  }
}

void write_command(const Config& config, const mjModel* m, mjData* d, const Coordinates& state) {
  const Model& model = config.model;
  if (!model.controller) return;
  double v[kMaxCoordinates];
  velocity_at_time(config, m, d, state, v);
  // Before it is on: 0, the value of mj_resetData.
  Eigen::Vector2d u{d->userdata[kHeldX], d->userdata[kHeldY]};
  if (d->time >= model.control_on) {
    const double sample =
        model.sample_time > 0.0 ? 1.0 + sample_index(d->time, model.sample_time) : 0.0;
    if (sample == 0.0 || sample != d->userdata[kSample]) {
      u = control_command(model, d->time, state.q(), v, first_touch(config, d));
      d->userdata[kHeldX] = u.x();
      d->userdata[kHeldY] = u.y();
      d->userdata[kSample] = sample;
    }
  }
  const Eigen::Vector2d told = model.magnets ? u : to_axes(u);
  for (int k = 0; k < 2; ++k) d->ctrl[config.actuator[k]] = told[k];
}

ActuatorState actuator_state(const Config& config, const mjModel* m, const mjData* d) {
  if (config.actuator[0] < 0 || config.actuator[1] < 0) return {};
  Eigen::Vector2d force, current{0.0, 0.0};
  for (int k = 0; k < 2; ++k) {
    force[k] = d->actuator_force[config.actuator[k]];
    if (config.model.magnets) current[k] = coil_current(m, d, config.actuator[k]);
  }
  return {from_axes(force), current};
}

}  // namespace rotorub::plugin
