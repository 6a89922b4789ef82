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
  // Lays the record beside the scene as it stands.
  Residuals(const ReadScene& read, MeasuredRecord record, const Parameters& parameters);

  // Unknowns in [0, 1]: of each value its place in its range, in the logarithm where that spans a
  // decade or more; then that of the shift, where it is not given.
  std::size_t unknowns() const { return wanted_.size() + (shift_held_ ? 0 : 1); }
  double value(std::size_t k, double x) const;       // SI
  double slope(std::size_t k, double x) const;       // d value / dx
  double shift(const std::vector<double>& x) const;  // s
  std::vector<std::string> overrides(const std::vector<double>& x) const;

  // A run, what it leaves, and how that is judged.
  struct Point {
    std::unique_ptr<Trajectory> run;
    std::unique_ptr<SampledRun> sampled;
    std::unique_ptr<Fitting> fitting;
    Fit fit;
    double square() const { return fit.left().squaredNorm(); }
  };
  // None: no such scene, or its run did not come to its end.
  std::optional<Point> at(const std::vector<double>& x);

  // Weighs each channel by what is left of it at a point.
  void weigh(const Point& point);

  const Alignment& as_it_stood() const { return before_; }
  std::size_t samples() const { return record_.t.size(); }
  const MeasuredRecord& record() const { return record_; }
  int runs() const { return runs_; }

 private:
  Trajectory run(const scene::Scene& scene, double shift);
  bool is_logarithmic(const Wanted& w) const { return w.from > 0.0 && w.to >= 10.0 * w.from; }

  const ReadScene& read_;
  std::vector<Wanted> wanted_;
  MeasuredRecord record_;  // those that stay on the run at every shift looked at
  const std::atomic<bool>* interrupt_;
  Alignment before_;
  std::vector<Channel> channels_;
  std::optional<double> angle_;
  bool shift_held_ = false;
  double middle_ = 0.0, room_ = 0.0;  // s, of the shift
  int runs_ = 0;
};

}  // namespace rotorub::identify
