// How well a record lies on a run: by which signals, and at the shift that leaves least.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/measured/record.h"
#include "compare/measured/sampled_run.h"

namespace rotorub {

// A column, or a pair x + i y that turns with the frame of the sensors. Values are shares of the
// run's standard deviation.
struct Channel {
  const Measurable* what = nullptr;  // x, where it is a pair
  bool pair = false;
  double frame = 0.0;      // rad: of a column alone, that of the sensors where it is given
  double scale = 1.0;      // SI: the run's standard deviation, > 0
  SampleTimes times;       // of the record's samples that have a value, by its clock
  Eigen::VectorXcd value;  // of these

  std::string name() const;  // "rotor", "gap"
  // Of the run; a pair in the scene's frame, x or y alone in that of the sensors.
  Eigen::VectorXcd of(const SampledRun& run, const SampleTimes& at) const;
};

// Those of the first group (Measurable::group) that record and run both move in; empty where there
// is none. angle: of the sensors' frame, rad, 0 where it is not given.
std::vector<Channel> channels_of(const MeasuredRecord& record, const SampledRun& run, double angle);

// At a shift: the run's values and the record's, turned into the scene, each less its mean; of all
// channels, pairs first, over their scales.
struct Fit {
  double angle = 0.0;  // rad
  Eigen::VectorXcd run, record;

  Eigen::VectorXcd left() const { return record - run; }
  double correlation() const;  // 0 where one of them does not move
  // rms of the record over the run's; 0 where the run does not move.
  double gain() const;
};

// The samples that stay on the run while the shift is varied by `room` (s) about `shift`. angle:
// held; none: the best at each shift, in closed form.
class Fitting {
 public:
  Fitting(const SampledRun& run, const std::vector<Channel>& channels, double interval,
          double shift, double room, std::optional<double> angle);

  // Real numbers fitted.
  std::size_t values() const { return static_cast<std::size_t>(record_.size() + pairs_); }
  Fit at(double shift) const;

  // Rms of what is left of a channel, over its scale.
  double rms(const Channel& channel, const Fit& fit) const;

  // The shift within h (s, of the search's grid) of `shift` that leaves least: first coarse where
  // the grid is wider than the record's interval, then where the slope of what is left is 0.
  double refined(double shift, double h) const;

  // What the shift (s) and the angle do to what is left: derivatives, d by central differences, e
  // of a turn of the frame by a, which moves m by i a m: what is left grows as if the run went back
  // by that. Of m what the run explains, g s: the noise in m would look like a motion of its own,
  // by which a turn differs from a shift. e is 0 where the angle is held.
  struct Effects {
    Eigen::VectorXcd d, e;
    double dd, de, ee;  // products
  };
  Effects effects(const Fit& fit, double shift) const;

  // Standard deviation of an estimate sum(f r) / sum(f f), r what is left. None where f is nothing.
  // Of r as white noise, with a variance of its own in each channel; where the sums of f r over
  // stretches of 2, 4, ... intervals, kLeastBlocks of them or more, scatter by more than white
  // noise does, that of the independent stretches: what a bootstrap by such blocks comes to
  // (H. Kuensch, "The jackknife and the bootstrap for general stationary observations", Ann. Stat.
  // 17, 1989). What a wrong model leaves is not white.
  std::optional<double> error(const Eigen::VectorXcd& f, const Fit& fit) const;
  static constexpr std::size_t kLeastBlocks = 8;

 private:
  struct Part {
    const Channel* channel;
    SampleTimes times;  // of the record's clock
    Eigen::Index first, count;
  };
  void add(const Channel& channel, double from, double to);
  std::pair<double, double> span() const;  // s, of the record's clock, of the samples fitted
  double block_scatter(const Eigen::VectorXd& pull, double length) const;
  Eigen::VectorXcd run_at(double shift) const;
  Eigen::VectorXcd rate_at(double shift) const;  // 1/s, by central differences

  const SampledRun& run_;
  double interval_;  // s, of the record
  std::optional<double> angle_;
  std::vector<Part> parts_;
  Eigen::VectorXcd record_;  // less its means
  Eigen::Index pairs_ = 0;   // of its values, those of pairs
};

}  // namespace rotorub
