// The difference between a record and the native run of a scene with given values, as a function to
// be minimised.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "compare/identify/identify.h"
#include "compare/measured/fitting.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub::identify {

class Residuals {
 public:
  Residuals(const ReadScene& read, MeasuredRecord record, const Parameters& parameters);

  // Unknowns in [0, 1]: the position of each value in its range, logarithmic if the range spans a
  // decade or more; and after align_record() the position of the shift in its range, unless it is
  // given.
  std::size_t values() const { return wanted_.size(); }
  std::size_t unknowns() const { return wanted_.size() + (options_.shift ? 0 : 1); }

  // Aligns the record with the run of these values at its best shift, however badly it fits,
  // because a wrong model fits at a wrong shift. Empty if there is no run or no common samples.
  std::optional<Alignment> aligned(const std::vector<double>& values);
  // Restricts the shift to a range around the one for these values. Throws MeasuredError if the
  // record does not fit their run.
  void align_record(const std::vector<double>& values);
  double value(std::size_t k, double x) const;       // SI
  double slope(std::size_t k, double x) const;       // d value / dx
  double shift(const std::vector<double>& x) const;  // s
  std::vector<std::string> overrides(const std::vector<double>& x) const;

  // A run and its difference from the record.
  struct Point {
    std::unique_ptr<Trajectory> run;
    std::unique_ptr<SampledRun> sampled;
    std::unique_ptr<Fitting> fitting;
    double shift = 0.0;  // s
    Fit fit;
    double square() const { return fit.left().squaredNorm(); }
    double rms() const;      // of the difference, without weights
    double run_rms() const;  // of the run, about its means
  };
  // Empty if there is no such scene or its run did not reach its end.
  std::optional<Point> at(const std::vector<double>& x);
  // The original scene's run with the same samples and weights, at the shift with the smallest
  // difference. Also empty if the record does not fit its run.
  std::optional<Point> as_it_stands();

  // Weights each channel by its difference at a point.
  void weigh(const Point& point);

  const Alignment& laid() const { return laid_; }
  std::size_t samples() const { return record_.t.size(); }
  const MeasuredRecord& record() const { return record_; }
  int runs() const { return runs_; }

 private:
  Trajectory run(const scene::Scene& scene, std::vector<double> rows);
  Trajectory even_run(const scene::Scene& scene);
  std::optional<Point> point_at(const std::vector<std::string>& overrides, double shift);
  bool is_logarithmic(const Wanted& w) const { return w.from > 0.0 && w.to >= 10.0 * w.from; }

  const ReadScene& read_;
  std::vector<Wanted> wanted_;
  MeasuredRecord record_;  // only samples that stay on the run at every shift in the range
  AlignmentOptions options_;
  const std::atomic<bool>* interrupt_;
  Alignment laid_;
  std::vector<Channel> channels_;
  std::optional<double> angle_;
  double middle_ = 0.0, room_ = 0.0;  // s, middle and half width of the range of the shift
  int runs_ = 0;
};

}  // namespace rotorub::identify
