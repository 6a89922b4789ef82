// The signals that a record is aligned by.
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "compare/measured/record.h"
#include "compare/measured/sampled_run.h"

namespace rotorub {

// A column, or a pair x + i y that turns with the frame of the sensors.
struct Channel {
  const MeasuredColumn* x = nullptr;
  const MeasuredColumn* y = nullptr;  // null: x alone, real
  double frame = 0.0;                 // rad: of x alone, the angle of the sensors' frame where it is given
  double scale = 0.0;                 // SI: standard deviation of the run's, > 0
  bool is_pair() const { return y != nullptr; }
  std::string name() const;  // "rotor", "gap"
};

// The first of these groups that record and run both move in: places (rotor, ring, gap); the contact's force; forces
// of lasting contact; control and currents; speed of spin. Empty where there is none. angle: of the sensors' frame,
// rad, 0 where it is not given.
std::vector<Channel> channels_of(const MeasuredRecord& record, const SampledRun& run, double angle);

// Of the record, SI, and where it has a value.
std::complex<double> record_value(const Channel& channel, std::size_t sample);
bool is_good(const Channel& channel, std::size_t sample);
// Of the run, at those times; a pair in the scene's frame, x or y alone in that of the sensors.
std::vector<std::complex<double>> run_values(const Channel& channel, const SampledRun& run, const SampleTimes& times);

}  // namespace rotorub
