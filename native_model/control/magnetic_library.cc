#include "native_model/control/magnetic_library.h"

#include <algorithm>
#include <limits>

namespace rotorub {
namespace {

rotorub_magnetic_bearing shown(const scene::MagneticBearing& bearing) {
  rotorub_magnetic_bearing b{};
  b.force_per_current = bearing.force_per_current();
  b.negative_stiffness = bearing.pull();
  b.current_limit = bearing.current_limit();
  b.force_constant = bearing.force_constant;
  b.bias_current = bearing.bias_current;
  b.air_gap = bearing.air_gap;
  b.bandwidth =
      bearing.amplifier ? bearing.amplifier->bandwidth : std::numeric_limits<double>::infinity();
  return b;
}

}  // namespace

MagneticLibrary::MagneticLibrary(const scene::Scene& scene, std::span<const std::size_t> bearings)
    : ports_(2 * bearings.size()) {
  if (libraries_left_out()) return;
  const scene::SharedControl& control = *scene.magnetic_control;
  law_.emplace(scene, "magnetic_control", control.library);
  std::vector<rotorub_magnetic_bearing> all;
  for (const std::size_t k : bearings) all.push_back(shown(scene.magnetic_bearings[k]));
  rotorub_magnetic_setup setup{};
  setup.abi = ROTORUB_MAGNETIC_CONTROLLER_ABI;
  setup.sample_time = control.sample_time;
  setup.delay = control.delay;
  setup.ports = ports_;
  setup.bearings = all.data();
  law_->create(setup, control.config, kMostState);
}

void MagneticLibrary::step(const rotorub_magnetic_measurement& now, double* state,
                           double* current) const {
  if (currents_) {
    std::copy_n(currents_->begin(), ports_, current);
    return;
  }
  std::fill_n(current, ports_, 0.0);
  if (law_) law_->step(now, state, current, ports_);
}

}  // namespace rotorub
