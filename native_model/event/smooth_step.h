// One step of the smooth system between events: DOP853 with its step size, tolerances that follow
// the motion, and the dense output where it is asked for.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "native_model/event/parameters.h"
#include "native_model/event/phase.h"
#include "native_model/numerics/dop853.h"

namespace rotorub {

class SmoothStep {
 public:
  // All must outlive it.
  SmoothStep(const Model& model, const EventParameters& parameters, Phase& phase);

  // At the start of a run, with the first step's length, s.
  void begin(const Motion& start, double first);
  // Tolerances are relative to the largest of each kind met so far: displacements, speeds, angles,
  // spin; of currents to their limit.
  void meet(const Motion& motion);
  double largest_speed() const { return speed_; }           // m/s
  double largest_contact_speed(std::size_t contact) const;  // m/s, with its surface
  // After a jump of the state or of the loads.
  void restart(const Motion& motion);

  // A step from `from` to `limit` (s) at most, whose error is within the tolerances. Loads are
  // those before the break at `limit`. False: no step is small enough.
  bool advance(const Motion& from, double limit);
  // The end of the step becomes the state; the next one may go on from there without restart().
  void accept(Motion& motion);

  // Of the step: the system's fastest rate as its last two stages show it, 1/s, and the coordinate
  // it shows in.
  struct Stability {
    double rate = 0.0;
    int coordinate = 0;
  };
  Stability stability() const;

  double length() const { return step_.step(); }
  double end_time() const { return end_time_; }  // s; a step up to the limit ends there to the bit
  const double* end() const { return step_.end(); }
  // Over the stages of the step.
  const Margins& lowest(std::size_t contact) const { return lowest_[contact]; }
  double largest_normal(std::size_t contact) const { return largest_normal_[contact]; }  // N
  std::int64_t rejected() const { return rejected_; }

  // The solution within the step, theta in [0, 1].
  void dense(double theta, double* y);
  const double* at(double theta);  // valid until the next call
  // to_k += what y_i has gained since the step's start at times within it, s.
  void add_increments(int i, std::span<const double> times, double* to);
  const double* term(int d);  // of the nested form, see Dop853
  double time(double theta) const { return start_ + theta * step_.step(); }
  // The phase's multipliers and margins at a state within the step.
  void evaluate(const Motion& motion);
  // Of a contact at theta: its margins; N.
  const Margins& margins(std::size_t contact, double theta);
  double normal_force(std::size_t contact, double theta);

 private:
  double before_break(double t) const { return t < smooth_end_ ? t : smooth_end_; }
  void find_round_off(const Motion& motion);
  const double* tolerance_of(double h);
  void prepare_dense();
  void evaluate_at(double theta);

  const Model* model_;
  const EventParameters* parameters_;
  Phase* phase_;
  Dop853 step_;
  std::vector<double> tolerance_;
  // With compliant contacts: m/s^2, of each coordinate; the tolerance with it.
  std::vector<double> round_off_, allowed_;
  std::vector<double> y_, slope_;
  double start_ = 0.0, next_ = 0.0;  // s: the step's start, the length to try next
  double end_time_ = 0.0;
  double smooth_end_ = 0.0;  // s, the last instant before the next break
  bool dense_ready_ = false;
  std::vector<Margins> lowest_;  // of each contact
  std::vector<double> largest_normal_;
  std::int64_t rejected_ = 0;
  double displacement_ = 0.0, speed_ = 0.0, turn_ = 0.0, spin_ = 0.0;  // largest met
};

// An explicit step cannot be longer than the fastest decay of the system allows, however little is
// left of it. Such a system is stiff, and a run of it may take days: this says so in time, and
// by what.
class StiffnessWatch {
 public:
  StiffnessWatch(const Model& model, const EventParameters& parameters)
      : model_(&model), parameters_(&parameters) {}

  void begin() { steps_ = 0, stiff_ = 0, smooth_ = 0; }
  // After every accepted step, which has come to t (s) on its way to `end`: why the run is given
  // up. Empty where it is not: its steps are as long as its motion allows and there are no more
  // than parameters.most_steps to go, or no more than parameters.most_stiff_steps.
  std::optional<std::string> look(double t, double end, const SmoothStep& step);

 private:
  const Model* model_;
  const EventParameters* parameters_;
  std::int64_t steps_ = 0;
  std::int64_t begun_ = 0;  // steps_ and
  double since_ = 0.0;      // time, s, at the first of the stiff ones
  double last_ = 0.0;       // s, of the last look
  int stiff_ = 0, smooth_ = 0;
};

}  // namespace rotorub
