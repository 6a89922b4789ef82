// The event-driven reference: DOP853 between events, impacts and lift-off located to round-off on
// its dense output, the impact map in closed form, lasting contact as constrained modes, Zeno
// accumulation closed. Works with every force, drive and controller of a Model.
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "native_model/contact/impact_map.h"
#include "native_model/integrate/dop853.h"
#include "native_model/integrate/first_contact.h"
#include "native_model/integrate/phase.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub {

struct EventOptions {
  // Local error of a step, relative to the largest displacement, speed, ... met so far.
  double tolerance = 1e-12;
  // Gap rate, m/s, under which an impact takes no rebound: an accumulation closes.
  double closing_gap_rate = 1e-9;
  // Share of the accelerations that meet at the contact below which their sum is none: what the
  // tolerance leaves of it.
  double no_force = 1e-10;
  // Width, s, of the bins over which the normal force is averaged for its peak and mean square;
  // 0: neither is found.
  double force_bin = 0.0;
  // Events at one instant before the run is given up.
  int stall_limit = 1000;
};

class EventIntegrator {
 public:
  // Model and recorder must outlive it.
  EventIntegrator(const Model& model, const EventOptions& options = {});

  struct Result {
    Status status = Status::kOk;
    std::string message;
    std::int64_t steps = 0;     // accepted
    std::int64_t rejected = 0;
    double end = 0.0;           // s, reached
  };
  // From `start` to `end`. progress: fraction done.
  Result run(const State& start, double end, Recorder& recorder,
             const std::function<void(double)>& progress = {},
             const std::atomic<bool>* interrupt = nullptr);

 private:
  // The loop.
  void begin(const State& start);
  double next_break() const;
  // Within a step the loads are those on its own side of the break that ends it.
  double before_break(double t) const { return t < smooth_end_ ? t : smooth_end_; }
  void advance(double limit);
  double trial_until_accepted(double limit);
  void fail_step();
  void update_tolerances();
  void arrive_at_break();
  bool sample_controller();
  void prepare_dense();
  void fill_statistics();

  // Events within the accepted trial: theta in (0, 1], or above 1 for none.
  double locate();
  double locate_contact();
  double locate_margin();
  double margin_at(double theta);
  double locate_loss();

  // What happens at an event.
  void impact();
  bool outlasts_its_flight(const ContactPoint& p);
  void finite_impact(const ContactPoint& p, ImpactInput in, Impact& record);
  void impact_phase(const Eigen::Vector2d& e_r, double tau, double normal, double friction,
                    Impact& record);
  void account(Impact& record, double normal, double friction, const Eigen::Vector2d& before,
               const Eigen::Vector2d& after);
  void book(const Impact& record, double held_slip);
  void fail_impact(ImpactStatus status);
  void end_of_contact();
  void decide(bool slip_is_zero, Departure departure);
  void enter(Mode mode, double sign);
  void leave(Departure departure);
  void to_circle(double t, double* q);
  void project(bool velocity, bool slip);
  void apply(const Eigen::Vector2d& e_r, double normal, double friction);

  // Rows.
  Snapshot snapshot(double t, const double* y);
  void bins_until(double now);
  double impulse_until(double t);
  void meet_energy();
  void rows_before(double t);
  void rows_at_now();

  void fail(Status status, const std::string& why);
  double* q() { return y_.data(); }
  double* v() { return y_.data() + model_->nq(); }

  const Model* model_;
  EventOptions options_;
  Phase phase_;
  Dop853 step_;
  Recorder* recorder_ = nullptr;
  Result result_;
  std::vector<double> breaks_;       // s, instants at which a load or the control is not smooth
  struct {
    std::vector<double> force, acceleration, before, after;  // nq each
  } touch_;                          // of an impact that takes time: loads held, v_0 and v_1
  std::vector<double> y_, row_, row_slope_, tolerance_, load_;
  double t_ = 0.0, h_ = 0.0, end_ = 0.0;
  double smooth_end_ = 0.0;          // s, the last instant before the next break
  double largest_displacement_ = 0.0, largest_speed_ = 0.0;
  double largest_turn_ = 0.0, largest_spin_ = 0.0;
  Departure departure_ = Departure::kInside;
  bool dense_ready_ = false;
  Phase::Margins lowest_{};          // over the stages of the trial
  double force_scale_ = 1e-300;      // N, largest normal force met
  double contact_time_ = 0.0;
  double impact_work_ = 0.0;         // J, on the coordinates
  double impact_force_ = 0.0;        // N, normal, within a phase of an impact that takes time
  double impact_impulse_ = 0.0;      // N s, normal, of all impacts so far
  double bin_ = 0.0;                 // index of the current force bin
  double bin_start_ = 0.0;           // N s, total normal impulse at its start
  double energy_start_ = 0.0;        // J, before an impact of the first instant
  double energy_scale_ = 0.0;        // J, largest met
  double next_sample_ = 0.0;         // index of the next controller sample
  int stalled_ = 0;
  double last_event_ = -1.0;
};

}  // namespace rotorub
