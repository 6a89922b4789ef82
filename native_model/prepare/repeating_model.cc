#include "native_model/prepare/repeating_model.h"

#include <cmath>
#include <utility>

#include "native_model/periodic/forcing.h"
#include "native_model/scene/scene.h"

namespace rotorub {

Model repeating_model(const scene::Scene& scene, Model given,
                      const std::function<Model(const scene::Scene&)>& make) {
  const double period = periodic::period_of_loads(given);
  if (period == 0.0 || periodic::sample_times(given).empty()) {
    return with_control_states(std::move(given));
  }
  const auto fit = [period](double& sample_time, double& delay) {
    if (!(sample_time > 0.0)) return;
    const double samples = std::round(delay / sample_time);
    sample_time = periodic::whole_sample_time(sample_time, period);
    delay = samples * sample_time;
  };
  scene::Scene whole = scene;
  for (scene::AuxiliaryBearing& at : whole.auxiliary) {
    if (at.controller) fit(at.controller->sample_time, at.controller->sensors.delay);
  }
  for (scene::MagneticBearing& bearing : whole.magnetic_bearings) {
    if (bearing.control) fit(bearing.control->sample_time, bearing.control->delay);
  }
  if (whole.magnetic_control) {
    fit(whole.magnetic_control->sample_time, whole.magnetic_control->delay);
  }
  return with_control_states(make(whole));
}

}  // namespace rotorub
