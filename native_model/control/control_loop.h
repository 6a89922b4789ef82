// A sampled controller at run time: sensors, trigger, law. The command is computed at k T and held
// until (k + 1) T. All memory is a plain array that the caller owns (the hold of a fixed-step
// integrator, or mjData.userdata).
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "native_model/control/controller.h"
#include "native_model/scene/auxiliary_bearing.h"

namespace rotorub {

// floor(t / T), the sample that holds at time t (s). Time steps reach k T only up to round-off, so
// a time that is early by round-off counts as k T.
inline double sample_index(double t, double sample_time) {
  return std::floor(t / sample_time * (1.0 + 1e-12));
}

// The sensors of a sampled controller: the measured quantities, their noise, resolution and delay.
// The noise depends only on the scene's seed and the number of the sample, so the native model and
// MuJoCo see the same errors.
class Sensors {
 public:
  // sample_time (s, > 0) must divide settings.delay; scene validation checks this.
  Sensors(const scene::Sensors& settings, double sample_time);

  // Number of doubles kept between samples; all 0 before the first sample.
  std::size_t memory_size() const;
  // Returns what the sensors show at a sample when the true values are `now`. Call it once per
  // sample, in order. Quantities that are not measured are 0; rotor_acceleration, which is the
  // model's, is only delayed. `t` and `sample` are the present ones, whatever the delay.
  Measurement measure(const Measurement& now, double* memory) const;

  // Bits ROTORUB_MEASURES_* of rotorub/controller.h.
  unsigned measured() const;
  // The same without noise and resolution.
  Sensors exact() const;
  // These three are those of ControlLoop.
  std::vector<std::size_t> returning_entries() const;
  void set_time(double last, double* memory) const;
  void set_spin_angles(double last, double growth, double* memory) const;

 private:
  Measurement with_errors(const Measurement& now) const;
  void put_differences(Measurement& shown, double* memory) const;
  Measurement delayed(const Measurement& shown, double* buffer, bool first) const;

  scene::Sensors settings_;
  std::size_t delay_;  // samples
};

// Returns a standard normal number that depends only on the seed, the sample and the channel.
double noise(int seed, std::int64_t sample, int channel);

// Returns whether rotor and ring have touched since the previous sample, judged by the sensors.
// Either the gap is closed now, or it would have closed since the previous sample at its rate then,
// and that rate has risen (a rebound). Closed means at most 1e-5 of the clearance, so that a
// contact that already exists when a trigger is armed counts at once in every engine. sample_time:
// s, since the previous sample. state: kTouchState numbers, 0 before the first sample.
inline constexpr std::size_t kTouchState = 2;
bool touched(const Measurement& now, double clearance, double sample_time, double* state);

class ControlLoop {
 public:
  // sample_time: s, > 0. clearance: m, 0 without a contact (there is no trigger then).
  ControlLoop(std::shared_ptr<const Controller> law, const scene::Sensors& sensors,
              const std::optional<scene::Trigger>& trigger, double sample_time, double clearance);

  // Number of doubles of memory; all 0 before the first sample.
  std::size_t memory_size() const;
  // The law's command at a sample (Controller::command); 0 until the trigger switches the law on.
  // Call it once per sample, in order. Throws ControllerError.
  Eigen::Vector2d sample(const Measurement& truth, double* memory) const;

  // The same loop with exact sensors: without noise and with an unlimited resolution.
  ControlLoop with_exact_sensors() const;

  const Controller& law() const { return *law_; }
  // The law's outputs at the last sample (Controller::outputs); 0 before it was switched on.
  static const double* outputs(const double* memory);
  // The entries of the memory that later commands depend on and that return in a periodic motion:
  // without times, spin angles, and the numbers of the switch-on.
  std::vector<std::size_t> returning_entries() const;
  // For the memory of a loop that has taken samples: sets the time of the last one, s.
  void set_time(double last, double* memory) const;
  // The same for the spin angles of delayed samples. last: rad, at the last sample. growth: rad,
  // from one sample to the next.
  void set_spin_angles(double last, double growth, double* memory) const;

 private:
  bool lets_in(const SwitchOn& now) const;

  std::shared_ptr<const Controller> law_;
  Sensors sensors_;
  std::optional<scene::Trigger> trigger_;
  double sample_time_;
  double clearance_;
};

}  // namespace rotorub
