// One step of the smooth system between events: DOP853 with step size control, tolerances that
// follow the motion, and dense output on request.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "native_model/event/parameters.h"
#include "native_model/event/smooth_system.h"
#include "native_model/numerics/dop853.h"

namespace rotorub {

class SmoothStep {
 public:
  // All must outlive this object.
  SmoothStep(const Model& model, const EventParameters& parameters, SmoothSystem& system);

  // Begins a run; first: length of the first step, s.
  void begin(const Motion& start, double first);
  // Updates the tolerances. They are relative to the largest displacement, speed and spin so far,
  // to 1 rad for angles, and to the limit for currents.
  void update_tolerances(const Motion& motion);
  double largest_speed() const { return speed_; }           // m/s
  double largest_contact_speed(std::size_t contact) const;  // m/s, including the rotor's surface
  // Call it after a jump of the state or of the loads.
  void restart(const Motion& motion);

  // Takes a step from `from` to at most `limit` (s) with an error within the tolerances. Loads are
  // those before the break at `limit`. False if no step is small enough.
  bool advance(const Motion& from, double limit);
  // Makes the end of the step the state. The next step may continue from there without restart().
  void accept(Motion& motion);

  // The fastest rate of the system, 1/s, estimated from the last two stages of the step, and the
  // coordinate in which it appears.
  struct Stability {
    double rate = 0.0;
    int coordinate = 0;
  };
  Stability stability() const;

  double length() const { return step_.step(); }
  double end_time() const { return end_time_; }  // s; exactly the limit if the step reaches it
  const double* end() const { return step_.end(); }
  // Extremes over the stages of the step.
  const Margins& lowest(std::size_t contact) const { return lowest_[contact]; }
  double largest_normal(std::size_t contact) const { return largest_normal_[contact]; }  // N

  // The solution within the step, theta in [0, 1].
  void dense(double theta, double* y);
  const double* at(double theta);  // valid until the next call
  // to_k += increment of y_i from the start of the step to times[k], s, within it.
  void add_increments(int i, std::span<const double> times, double* to);
  const double* term(int d);  // of the nested form, see Dop853
  double time(double theta) const { return start_ + theta * step_.step(); }
  // The theta of an instant `t` (s); exactly 1 at the end of the step and beyond it.
  double theta(double t) const {
    return t >= end_time_ ? 1.0 : std::min(1.0, (t - start_) / step_.step());
  }
  // Evaluates the phase's multipliers and margins at a state within the step.
  void evaluate(const Motion& motion);
  // The margins of a contact at theta; its normal force, N.
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
  SmoothSystem* system_;
  Dop853 step_;
  std::vector<double> tolerance_;
  // With compliant contacts: acceleration by round-off for each coordinate, m/s^2; the tolerance
  // including it.
  std::vector<double> round_off_, allowed_;
  std::vector<double> y_, slope_;
  double start_ = 0.0, next_ = 0.0;  // s: start of the step; next length to try
  double end_time_ = 0.0;
  double smooth_end_ = 0.0;  // s, the last instant before the next break
  bool dense_ready_ = false;
  std::vector<Margins> lowest_;  // one per contact
  std::vector<double> largest_normal_;
  double displacement_ = 0.0, speed_ = 0.0, spin_ = 0.0;  // largest so far
};

// An explicit step cannot be longer than the fastest decay of the system allows, even if this decay
// is almost over. Such a system is stiff, and its run may take days. StiffnessWatch detects this
// early and names the cause.
class StiffnessWatch {
 public:
  StiffnessWatch(const Model& model, const EventParameters& parameters)
      : model_(&model), parameters_(&parameters) {}

  void begin() { count_ = {}; }
  void count_impact() { ++count_.impacts; }
  // Call it after every accepted step; t (s) is its start on the way to `end` (its end may lie
  // beyond an event, and so beyond the start of the next step). Returns the reason to stop the run.
  // The result is empty if not more than parameters.most_stiff_steps remain; or if the motion, not
  // stability, limits the steps and not more than parameters.most_steps remain. It also stops for
  // impacts without end (parameters.most_impacts).
  std::optional<std::string> check(double t, double end, const SmoothStep& step);

 private:
  const Model* model_;
  const EventParameters* parameters_;
  struct Count {
    std::int64_t steps = 0;
    std::int64_t impacts = 0;       // since the last check
    std::int64_t fast_impacts = 0;  // at a pace at which too many would remain
    std::int64_t first_stiff = 0;   // steps at the first stiff check
    double first_stiff_time = 0.0;  // s
    double last_check = 0.0;        // s
    int stiff = 0, smooth = 0;      // checks
  };
  Count count_;
};

}  // namespace rotorub
