// A simulated run as a sensor would see it: its quantities at any times within it.
#pragma once

#include <span>
#include <vector>

#include "compare/measured/record.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// When a record has its samples, and what a value that is averaged over a sample is the mean over:
// half-way to the neighbours, and half an interval where a neighbour is two intervals away or more,
// or there is none.
struct SampleTimes {
  std::vector<double> t, from, to;  // s, ascending

  void add(const SampleTimes& others, std::size_t index);
};
SampleTimes sample_times(std::span<const double> t, double interval);
SampleTimes shifted(SampleTimes times, double by);

class SampledRun {
 public:
  // Rows: two or more. The run must outlive it.
  explicit SampledRun(const Trajectory& run);

  double start() const { return t_->front(); }  // s
  double end() const { return t_->back(); }     // s
  bool has(const Measurable& what) const;

  // SI, at times that ascend; before the start and after the end the values there.
  //   places: cubic between rows, by their rates; other columns: linear
  //   the contact's force: the momentum it gave from `from` to `to` over that time, that of an
  //   impact (rigid law) whole at its instant
  std::vector<double> values(const Measurable& what, const SampleTimes& times) const;

  // The same as sensors see it whose x axis stands at `angle` (rad, from x to y) in the scene: a
  // column along x or y is turned into their frame.
  std::vector<double> values(const Measurable& what, const SampleTimes& times, double angle) const;

 private:
  std::vector<double> momentum_at(std::span<const double> t) const;

  const Trajectory* run_;
  const std::vector<double>* t_;
  // N s that the normal force has given: up to each row, and by impacts, in all after each of them.
  std::vector<double> momentum_, impact_t_, impact_momentum_;
};

}  // namespace rotorub
