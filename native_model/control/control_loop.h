// A sampled controller as it is run: sensors, trigger, law. All that it remembers is a plain array
// that the caller owns (a fixed step's hold, mjData.userdata, an ensemble's lane).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>

#include "native_model/control/controller.h"
#include "native_model/control/sensors.h"

namespace rotorub {

class ControlLoop {
 public:
  // sample_time: s, > 0; clearance: m, 0 without a contact (then there is no trigger).
  ControlLoop(std::shared_ptr<const Controller> law, const scene::Sensors& sensors,
              const std::optional<scene::Trigger>& trigger, double sample_time, double clearance);

  // Numbers that are remembered; all 0 before the first sample.
  std::size_t memory_size() const;
  // The law's command at a sample (Controller::command); 0 until the trigger lets it in. Once a
  // sample, in order. Throws ControllerError.
  Eigen::Vector2d sample(const Measurement& truth, double* memory) const;

  const Controller& law() const { return *law_; }
  // The law's outputs at the last sample (Controller::outputs); 0 before it was let in.
  static const double* outputs(const double* memory);

 private:
  bool lets_in(const SwitchOn& now) const;

  std::shared_ptr<const Controller> law_;
  Sensors sensors_;
  std::optional<scene::Trigger> trigger_;
  double clearance_;
};

}  // namespace rotorub
