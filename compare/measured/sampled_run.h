// A simulated run as a sensor would measure it: its quantities at any times within it.
#pragma once

#include <span>
#include <vector>

#include "compare/measured/record.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// The times of a record's samples, and the interval over which an averaged value is taken: half-way
// to the neighbours, or half an interval if a neighbour is missing or at least two intervals away.
struct SampleTimes {
  std::vector<double> t, from, to;  // s, ascending

  void add(const SampleTimes& others, std::size_t index);
};
SampleTimes sample_times(std::span<const double> t, double interval);
SampleTimes shifted(SampleTimes times, double by);

class SampledRun {
 public:
  // The run needs at least two rows and must outlive this.
  explicit SampledRun(const Trajectory& run);

  double start() const { return t_->front(); }  // s
  double end() const { return t_->back(); }     // s
  bool has(const Measurable& what) const;

  // SI, at ascending times; before the start and after the end, the values at the ends.
  //   places: cubic between rows, using their rates; other columns: linear
  //   contact force: the impulse from `from` to `to` divided by that time; the impulse of a rigid
  //   impact acts at its instant
  std::vector<double> values(const Measurable& what, const SampleTimes& times) const;

  // The same for sensors whose x axis is at `angle` (rad, from x to y) in the scene: a column along
  // x or y is turned into their frame.
  std::vector<double> values(const Measurable& what, const SampleTimes& times, double angle) const;

 private:
  std::vector<double> momentum_at(std::span<const double> t) const;

  const Trajectory* run_;
  const std::vector<double>* t_;
  // N s, impulse of the normal force: up to each row, and the sum of the impacts after each impact.
  std::vector<double> momentum_, impact_t_, impact_momentum_;
};

}  // namespace rotorub
