// The signals that a record is aligned by.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "compare/measured/record.h"
#include "compare/measured/sampled_run.h"

namespace rotorub {

// A column, or a pair x + i y that turns with the frame of the sensors. Values are shares of the
// run's standard deviation.
struct Channel {
  const Measurable* what = nullptr;  // x, where it is a pair
  bool pair = false;
  double frame = 0.0;             // rad: of a column alone, that of the sensors where it is given
  double scale = 1.0;             // SI: the run's standard deviation, > 0
  std::vector<std::size_t> good;  // samples of the record that have a value
  Eigen::VectorXcd value;         // the record's, of these

  std::string name() const;  // "rotor", "gap"
  // Of the run; a pair in the scene's frame, x or y alone in that of the sensors.
  Eigen::VectorXcd of(const SampledRun& run, const SampleTimes& times) const;
};

// Those of the first group (Measurable::group) that record and run both move in; empty where there
// is none. angle: of the sensors' frame, rad, 0 where it is not given.
std::vector<Channel> channels_of(const MeasuredRecord& record, const SampledRun& run, double angle);

Eigen::VectorXcd without_mean(const Eigen::VectorXcd& z);

}  // namespace rotorub
