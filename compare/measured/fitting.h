// How well a record lies on a run at a shift, and the shift between the samples at which it lies
// best.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "compare/measured/channel.h"

namespace rotorub {

// At a shift: the run's values and the record's, turned into the scene, each less its mean; of all
// channels, pairs first, over their scales.
struct Fit {
  double angle = 0.0;  // rad
  Eigen::VectorXcd run, record;
  Eigen::VectorXcd left() const { return record - run; }
  double correlation() const;  // 0 where one of them does not move
};

// The samples that stay on the run while the shift is varied by `room` (s) about `shift`. angle:
// held; none: the best at each shift, in closed form.
class Fitting {
 public:
  Fitting(const MeasuredRecord& record, const SampledRun& run, const std::vector<Channel>& channels,
          double shift, double room, std::optional<double> angle);

  std::size_t values() const;  // real numbers fitted
  Fit at(double shift) const;

  // What the shift (s) and the angle do to what is left: derivatives, d by central differences over
  // `h` (s), e of a turn of the frame by a, which moves m by i a m: what is left grows as if the
  // run went back by that. e is 0 where the angle is held.
  struct Effects {
    Eigen::VectorXcd d, e;
    double dd, de, ee;  // products
  };
  Effects effects(const Fit& fit, double shift, double h) const;

  // Standard deviation of an estimate sum(f r) / sum(f f), where r, what is left, is white with a
  // variance of its own in each channel. None where f is nothing.
  std::optional<double> error(const Eigen::VectorXcd& f, const Fit& fit) const;

 private:
  struct Part {
    const Channel* channel;
    SampleTimes times;  // of the record's clock
    Eigen::Index first, count;
  };
  void add(const Channel& channel, const SampleTimes& all, double from, double to);
  Eigen::VectorXcd run_at(double shift) const;

  const SampledRun& run_;
  std::optional<double> angle_;
  std::vector<Part> parts_;
  Eigen::VectorXcd record_;  // less its means
  Eigen::Index pairs_ = 0;   // of its values, those of pairs
};

// The shift within h (s, of the search's grid) of `shift` that leaves least: first coarse where the
// grid is wider than the record's interval (s), then by Levenberg and Marquardt.
double refined(const Fitting& fitting, double shift, double h, double interval);

}  // namespace rotorub
