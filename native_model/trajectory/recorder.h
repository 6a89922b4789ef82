// Turns the states of an engine, passed step by step, into a Trajectory: series rows at the
// requested times (exactly as given; cubic Hermite interpolation between the steps of a fixed-step
// engine, linear across an impact), impacts, changes of mode, statistics and energy balance.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "native_model/contact/kinematics.h"
#include "native_model/scene/run.h"
#include "native_model/trajectory/columns.h"
#include "native_model/trajectory/keyphasor.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Window in steps of a scene: a soft contact that is as stiff as its step allows rebounds within 16
// steps (mjcf/soft_contact.h).
inline constexpr double kWindowSteps = 20.0;

// Largest normal impulse within a window of time, which measures a blow independently of how an
// engine spreads it. An impact is a single impulse under the rigid law and about twenty steps of
// force under a soft one; its force averaged over a step depends on the step alone.
class ImpulseWindow {
 public:
  // width: s; 0: off.
  explicit ImpulseWindow(double width = 0.0) : bin_(width / static_cast<double>(kParts)) {}
  double width() const { return static_cast<double>(kParts) * bin_; }

  // t: s, ascending; impulse: N s.
  void add(double t, double impulse) {
    if (bin_ <= 0.0) return;
    const auto bin = static_cast<double>(static_cast<std::int64_t>(t / bin_));  // t >= 0
    if (bin != now_) move_to(bin);
    bins_[newest_] += impulse;
    sum_ += impulse;
    largest_ = std::max(largest_, sum_);
  }
  double largest() const { return largest_; }  // N s

 private:
  // Bins of a window; bins_ has one more, so that a blow of full width fits in.
  static constexpr std::size_t kParts = 20;

  void move_to(double bin) {
    const double moved = bin - now_;
    now_ = bin;
    if (!(moved >= 0.0 && moved <= static_cast<double>(kParts))) {
      bins_.fill(0.0);
      sum_ = 0.0;
      return;
    }
    for (int k = 0; k < static_cast<int>(moved); ++k) {
      newest_ = newest_ == kParts ? 0 : newest_ + 1;
      sum_ -= bins_[newest_];
      bins_[newest_] = 0.0;
      // A new sum in each round keeps round-off from adding up.
      if (newest_ == 0) sum_ = std::accumulate(bins_.begin(), bins_.end(), 0.0);
    }
  }

  double bin_, now_ = 0.0, sum_ = 0.0, largest_ = 0.0;
  std::size_t newest_ = 0;
  std::array<double, kParts + 1> bins_{};
};

// Requested times: multiples of series_step in [0, end], the end and output_times, ascending and
// without duplicates. output_times and the end replace a multiple within 1e-9 of the spacing.
std::vector<double> output_times(const scene::Run& run);

// The keyphasor's record of a state in which the mark passes.
KeyphasorPass keyphasor_pass(const Model& model, double t, const double* q, const double* v);

// Effects of one step, for an engine that computes its own work.
struct StepFigures {
  double h = 0.0;               // s, duration over which the impulses act
  double normal_impulse = 0.0;  // N s, total of the step, including an impact's
  double friction_impulse = 0.0;
  double friction_work = 0.0;  // J, of friction between the surfaces
  double contact_work = 0.0;   // J, on the coordinates
  double external_work = 0.0;  // J, of all forces but springs and contact
  bool impact = false;         // whether the impulses are those of an impact
};

// Energy balance of one step, as computed by the engine.
struct StepBalance {
  double energy = 0.0;         // J
  double contact_work = 0.0;   // J, on the coordinates, since the last step
  double external_work = 0.0;  // J, of all forces but springs and contact, since the last step
};

class Recorder {
 public:
  struct Span {
    double begin, end;  // s
  };
  // times: of the requested rows, ascending. window: s, see ImpulseWindow.
  Recorder(const Model& model, std::vector<double> times, double window = 0.0);

  void begin(const Snapshot& start);
  // Records one fixed step from the last snapshot to `now`. The impulses are totals over the step,
  // N s, including an impact's. impact: set if velocities jump within this step; friction then
  // works at the slips of the impact.
  void step(const Snapshot& now, double normal_impulse, double friction_impulse,
            const Impact* impact, const StepBalance& balance);
  // For engines that compute their own work: count() adds the effects of a step that begins at
  // `begin` (s), advance() records the next snapshot. The energy is evaluated only now and then,
  // because it costs a model evaluation.
  void count(const StepFigures& figures, double begin);
  // points: the contacts at `now`, of which only those of auxiliary bearings with a contact are
  // used. impact: whether velocities jump within the step.
  void advance(const Snapshot& now, std::span<const ContactPoint> points, bool impact);
  // The actuator's part of a snapshot is read only if a row is due by its time.
  bool row_due(double t) const { return next_time() <= t * (1.0 + 1e-9); }
  void add(const Impact& impact);
  void add(const Event& event);
  // Adds to the figures of a contact its effects over h (s) from `begin` (s) on, N s and J.
  void count_at(std::size_t contact, double begin, double h, double normal_impulse,
                double friction_impulse, double friction_work);
  // Adds a contact after the first to a step that step() counts. before: total normal impulse of
  // the contacts before it, N s.
  void count_further(std::size_t contact, double begin, double h, double normal_impulse,
                     double friction_impulse, double friction_work, double before);
  // Counts an episode of a soft contact that starts at `begin` and lasts `lasted` s: an impact if
  // it fits within the window, else lasting contact. An impact during lasting contact of another
  // contact adds no time of its own.
  void count_episode(double begin, double lasted);
  // For engines with their own dense output: the next requested time (infinity: none left), a row
  // at exactly that time, and the statistics.
  double next_time() const;
  void row(const Snapshot& exact);
  Statistics& statistics() { return statistics_; }
  Keyphasor& keyphasor() { return keyphasor_; }
  // For an engine that counts the contact itself: its normal impulse at about time t.
  void watch_impulse(double t, double impulse) { window_.add(t, impulse); }
  double window() const { return window_.width(); }

  // Ends the recording; the recorder is empty afterwards. Leaves the names, the step and the time
  // of computation of the trajectory to the caller.
  Trajectory finish(const RunEnd& end);

 private:
  void move_to(const Snapshot& now, std::span<const ContactPoint> points, bool impact);
  void keep(const Snapshot& now, std::span<const ContactPoint> points);
  // The contacts at a snapshot; valid until the next call.
  std::span<const ContactPoint> points_of(const Snapshot& now);
  void look_at_energy();
  void meet_energy(double now);
  void count_contact(double normal_impulse, double friction_impulse, double h, double begin,
                     bool impact);
  void count_gap(std::size_t contact, const ContactPoint& point);
  void meet_gaps(const double* q);
  void rows_until(const Snapshot& now, bool impact);
  void interpolate(const Snapshot& now, double share, bool impact);  // writes q_, v_
  void passes_until(const Snapshot& now, bool impact);

  const Model* model_;
  std::vector<double> times_;
  std::size_t next_ = 0;
  double last_t_ = 0.0;  // s, of the last snapshot
  std::vector<double> last_q_, last_v_, q_, v_;
  double last_step_ = 0.0;  // s, from the snapshot before to the last one
  // J: normal force times clearance, summed over the contacts that are closed at the last row. A
  // rotor at rest has no energy against which round-off could be compared.
  double resting_ = 0.0;
  std::int64_t steps_ = 0;
  double lasted_ = 0.0;     // s of lasting contact counted since the last snapshot
  double last_slip_ = 0.0;  // m/s, of the first contact
  std::vector<Column> columns_;
  bool switches_unbalance_ = false;   // an unbalance appears during the run, see switching_work()
  std::vector<ContactPoint> points_;  // of points_of()
  std::vector<double> least_gaps_;    // m, at the start and at the rows, of each contact
  bool soft_ = false;                 // whether several soft contacts exist and have touched
  std::vector<Span> lasting_;         // episodes of soft contacts that count as lasting contact
  std::vector<Impact> impacts_;
  std::vector<Event> events_;
  Statistics statistics_;
  ImpulseWindow window_;
  Keyphasor keyphasor_;
};

}  // namespace rotorub
