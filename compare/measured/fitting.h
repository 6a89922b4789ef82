// How well a record fits a run: the signals that are compared, and the shift with the least
// difference.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/measured/record.h"
#include "compare/measured/sampled_run.h"

namespace rotorub {

// A column, or a pair x + i y that turns with the sensors' frame. Values are relative to the run's
// standard deviation.
struct Channel {
  const Measurable* what = nullptr;  // for a pair: its x
  bool pair = false;
  double frame = 0.0;      // rad, of a single column: the given angle of the sensors
  double scale = 1.0;      // SI: the run's standard deviation, > 0
  SampleTimes times;       // of the record's samples that have a value, in the record's time
  Eigen::VectorXcd value;  // at these times

  std::string name() const;  // "rotor", "gap"
  // The run's values: a pair in the scene's frame, a single x or y in the sensors' frame.
  Eigen::VectorXcd of(const SampledRun& run, const SampleTimes& at) const;
};

// The channels of the first group (Measurable::group) in which both record and run move. Empty if
// no group has one. angle: rad, of the sensors' frame; 0 if it is not given.
std::vector<Channel> channels_of(const MeasuredRecord& record, const SampledRun& run, double angle);

// Run and record at a shift, with the record turned into the scene's frame. Each channel has its
// mean removed and is divided by its scale; pairs come first.
struct Fit {
  double angle = 0.0;  // rad
  Eigen::VectorXcd run, record;

  Eigen::VectorXcd left() const { return record - run; }
  double correlation() const;  // 0 if one of them does not move
  // Rms of the record relative to the run's; 0 if the run does not move.
  double gain() const;
};

// The samples that stay on the run while the shift varies by `room` (s) around `shift`. angle:
// given, or empty for the best angle at each shift, in closed form.
class Fitting {
 public:
  Fitting(const SampledRun& run, const std::vector<Channel>& channels, double interval,
          double shift, double room, std::optional<double> angle);

  // Number of real values in the fit.
  std::size_t values() const { return static_cast<std::size_t>(record_.size() + pairs_); }
  Fit at(double shift) const;

  // Rms of the difference in a channel, relative to its scale.
  double rms(const Channel& channel, const Fit& fit) const;

  // The shift within h (s, interval of the search's grid) of `shift` with the least difference:
  // first a coarse search if the grid is wider than the record's interval, then the zero of the
  // derivative.
  double refined(double shift, double h) const;

  // Effects of the shift (s) and of the angle on the difference. d is the derivative by the shift,
  // from central differences. e is the derivative by the angle: a turn of the frame moves the
  // record m by i m, with the same effect on the difference as the opposite motion of the run. Only
  // the component of m along the run, g s, is used, because the noise in m would act like a
  // separate motion that distinguishes a turn from a shift. e is 0 if the angle is given.
  struct Effects {
    Eigen::VectorXcd d, e;
    double dd, de, ee;  // scalar products
  };
  Effects effects(const Fit& fit, double shift) const;

  // Standard deviation of an estimate sum(f r) / sum(f f), with r the difference; empty if f is 0.
  // r counts as white noise with a separate variance in each channel. If the sums of f r over
  // blocks of 2, 4, ... intervals, at least kLeastBlocks of them, scatter by more than white noise,
  // their scatter as independent blocks is used, as in a block bootstrap (H. Kuensch, "The
  // jackknife and the bootstrap for general stationary observations", Ann. Stat. 17, 1989), because
  // the difference from a wrong model is not white.
  std::optional<double> error(const Eigen::VectorXcd& f, const Fit& fit) const;
  static constexpr std::size_t kLeastBlocks = 8;

 private:
  struct Part {
    const Channel* channel;
    SampleTimes times;  // in the record's time
    Eigen::Index first, count;
  };
  void add(const Channel& channel, double from, double to);
  std::pair<double, double> span() const;  // s, in the record's time, of the fitted samples
  double block_scatter(const Eigen::VectorXd& pull, double length) const;
  Eigen::VectorXcd run_at(double shift) const;
  Eigen::VectorXcd rate_at(double shift) const;  // 1/s, by central differences

  const SampledRun& run_;
  double interval_;  // s, of the record
  std::optional<double> angle_;
  std::vector<Part> parts_;
  Eigen::VectorXcd record_;  // without its means
  Eigen::Index pairs_ = 0;   // number of its values that belong to pairs
};

}  // namespace rotorub
