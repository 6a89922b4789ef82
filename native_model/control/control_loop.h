// A sampled controller as it is run: sensors, trigger, law. It takes its command at k T, which is
// held until (k + 1) T. All that it remembers is a plain array that the caller owns (a fixed step's
// hold, mjData.userdata).
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>

#include "native_model/control/controller.h"
#include "native_model/scene/auxiliary_bearing.h"

namespace rotorub {

// floor(t / T), the sample that holds at time t (s). Steps of a fixed length do not meet k T to the
// last bit: a time that is short of it by round-off counts as there.
inline double sample_index(double t, double sample_time) {
  return std::floor(t / sample_time * (1.0 + 1e-12));
}

// The sensors of a sampled controller: which quantities they measure, with what noise, resolution
// and delay. Every number depends on the scene's seed and the number of the sample alone, so the
// native model and MuJoCo are shown the same errors.
class Sensors {
 public:
  // sample_time (s, > 0) divides settings.delay (scene validation).
  Sensors(const scene::Sensors& settings, double sample_time);

  // Numbers that are remembered between samples; 0 before the first.
  std::size_t memory_size() const;
  // What is shown at a sample where the truth is `now`; ask once a sample, in order. What is not
  // measured is 0; `t` and `sample` are those of now, whatever the delay.
  Measurement measure(const Measurement& now, double* memory) const;

  // Bits of rotorub/controller.h.
  unsigned measured() const;

 private:
  Measurement with_errors(const Measurement& now) const;
  void put_differences(Measurement& shown, double* memory) const;
  Measurement delayed(const Measurement& shown, double* buffer, bool first) const;

  scene::Sensors settings_;
  std::size_t delay_;  // samples
};

// A standard normal number of channel `channel` at sample `sample`: always the same.
double noise(int seed, std::int64_t sample, int channel);

// Whether rotor and ring have touched since the sample before, from what the sensors show: the gap
// is closed now (to 1e-5 of the clearance, so that contact that lasts already when a trigger is
// armed is a touch at once, in every engine alike), or it would have closed on its way from the
// last sample to this one, at the rate that it had. state: kTouchState numbers, 0 before the first
// sample.
inline constexpr std::size_t kTouchState = 2;
bool touched(const Measurement& now, double clearance, double* state);

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
