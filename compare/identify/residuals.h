// What is left of a record beside the native run of a scene with given values: a function that can
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

  // Unknowns in [0, 1]: of each value its place in its range, in the logarithm where that spans a
  // decade or more; then, once the record is laid in, that of the shift, where it is not given.
  std::size_t values() const { return wanted_.size(); }
  std::size_t unknowns() const { return wanted_.size() + (options_.shift ? 0 : 1); }

  // The record laid on the run of these values wherever it lies best there, however badly: a wrong
  // model has it at a wrong shift. None where there is no run, or no samples in common.
  std::optional<Alignment> aligned(const std::vector<double>& values);
  // From here on the shift is looked for about that of these values. Throws MeasuredError where
  // the record does not lie on their run.
  void lay_in(const std::vector<double>& values);
  double value(std::size_t k, double x) const;       // SI
  double slope(std::size_t k, double x) const;       // d value / dx
  double shift(const std::vector<double>& x) const;  // s
  std::vector<std::string> overrides(const std::vector<double>& x) const;

  // A run, what it leaves, and how that is judged.
  struct Point {
    std::unique_ptr<Trajectory> run;
    std::unique_ptr<SampledRun> sampled;
    std::unique_ptr<Fitting> fitting;
    double shift = 0.0;  // s
    Fit fit;
    double square() const { return fit.left().squaredNorm(); }
    double rms() const;      // of what is left, over the weights
    double run_rms() const;  // of the run, about its means
  };
  // None: no such scene, or its run did not come to its end.
  std::optional<Point> at(const std::vector<double>& x);
  // Of the scene as it stands, by the same samples and weights, at the shift that leaves least
  // there. None too where the record lies nowhere on its run.
  std::optional<Point> as_it_stands();

  // Weighs each channel by what is left of it at a point.
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
  MeasuredRecord record_;  // those that stay on the run at every shift looked at
  AlignmentOptions options_;
  const std::atomic<bool>* interrupt_;
  Alignment laid_;
  std::vector<Channel> channels_;
  std::optional<double> angle_;
  double middle_ = 0.0, room_ = 0.0;  // s, of the shift
  int runs_ = 0;
};

}  // namespace rotorub::identify
