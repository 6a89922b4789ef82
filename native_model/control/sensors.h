// The sensors of a sampled controller: which quantities they measure, with what noise, resolution
// and delay. Every number depends on the scene's seed and the number of the sample alone, so the
// native model and MuJoCo are shown the same errors.
#pragma once

#include <cstddef>

#include "native_model/control/controller.h"
#include "native_model/scene/scene.h"

namespace rotorub {

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

}  // namespace rotorub
