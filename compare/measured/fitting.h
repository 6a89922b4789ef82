// How well a record lies on a run at a shift, and the shift between the samples at which it lies best.
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "compare/measured/channel.h"

namespace rotorub {

// What is left at a shift, with s the run's values, m the record's turned into the scene, each less its mean; sums over
// samples and channels of squares and products over the channel's scale squared.
struct Fit {
  double angle = 0.0;                          // rad
  double left = 0.0;                           // |s - m|^2
  double run = 0.0, record = 0.0, both = 0.0;  // |s|^2, |m|^2, Re conj(m) s
  std::vector<double> noise;                   // of each channel: mean square of what is left, a real number
  double correlation() const;                  // 0 where one of them does not move
};

// Products of the gradients at a fit, of one channel: of the shift's effect d on what is left, of the angle's e, and of
// what is left, r.
struct Effects {
  double dd = 0.0, de = 0.0, ee = 0.0, dr = 0.0, er = 0.0;
  double across() const { return ee > 0.0 ? de / ee : 0.0; }
  double own() const { return dd - across() * de; }  // of the shift, that no turn explains
};
Effects total(const std::vector<Effects>& all);

// The samples that stay on the run while the shift is varied by `room` (s) about `shift`. angle: held; none: the best
// at each shift, in closed form.
class Fitting {
 public:
  Fitting(const MeasuredRecord& record, const SampledRun& run, const std::vector<Channel>& channels, double shift,
          double room, std::optional<double> angle);

  std::size_t values() const { return values_; }  // real numbers fitted
  Fit at(double shift) const;
  // Of each channel, by central differences over `h` (s).
  std::vector<Effects> effects(const Fit& fit, double shift, double h) const;

 private:
  struct FittedChannel {
    Channel channel;
    SampleTimes times;                    // of the record's clock
    std::vector<std::complex<double>> m;  // less its mean
  };
  static double weight(const FittedChannel& c) { return 1.0 / (c.channel.scale * c.channel.scale); }
  static std::complex<double> turn(const FittedChannel& c, double angle);
  std::vector<std::complex<double>> run_at(const FittedChannel& c, double shift) const;

  const SampledRun& run_;
  std::optional<double> angle_;
  std::vector<FittedChannel> channels_;
  std::size_t values_ = 0;
};

// The shift within h (s, of the search's grid) of `shift` that leaves least: first coarse where the grid is wider than
// the record's interval (s), then by Brent, and by Gauss and Newton, who end in round-off where nothing is left.
double refined(const Fitting& fitting, double shift, double h, double interval);

// Standard deviation of an estimate sum(f r) / sum(f f), where r is white with a variance of its own in each channel
// and f = d - across e (of the shift), or e - across d (of the angle). None where f is nothing.
std::optional<double> estimate_error(const std::vector<Effects>& all, const std::vector<double>& noise, bool shift,
                                     double across);

}  // namespace rotorub
