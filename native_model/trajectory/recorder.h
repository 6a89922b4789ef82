// Turns the states of an engine, fed step by step, into a Trajectory: series rows at the requested
// times (exactly as given; cubic Hermite between the steps of a fixed-step engine, linear across an
// impact), impacts, changes of mode, statistics, energy balance.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "native_model/contact/kinematics.h"
#include "native_model/scene/run.h"
#include "native_model/trajectory/columns.h"
#include "native_model/trajectory/keyphasor.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Steps of a scene: a soft contact that is as stiff as its step allows bounces in 16
// (mjcf/soft_contact.h).
inline constexpr double kWindowSteps = 20.0;

// The largest normal impulse within a window of time: what the contact gives at once, however an
// engine spreads it. An impact is one number under the rigid law and some twenty steps of force
// under a soft one; its force averaged over a step is a number of the step alone.
class ImpulseWindow {
 public:
  // width: s; 0: nothing is watched.
  explicit ImpulseWindow(double width = 0.0) : bin_(width / static_cast<double>(kParts)) {}
  double width() const { return static_cast<double>(kParts) * bin_; }

  // t: s, ascending; impulse: N s.
  void add(double t, double impulse) {
    if (bin_ <= 0.0) return;
    const double bin = std::floor(t / bin_);
    if (bin != now_) move_to(bin);
    bins_[newest_] += impulse;
    sum_ += impulse;
    largest_ = std::max(largest_, sum_);
  }
  double largest() const { return largest_; }  // N s

 private:
  static constexpr std::size_t kParts = 20;  // of a window, and one more: all of a blow is in it

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
      bins_[newest_] = 0.0;
    }
    sum_ = std::accumulate(bins_.begin(), bins_.end(), 0.0);
  }

  double bin_, now_ = 0.0, sum_ = 0.0, largest_ = 0.0;
  std::size_t newest_ = 0;
  std::array<double, kParts + 1> bins_{};
};

// The requested times: multiples of series_step in [0, end], the end and output_times, ascending,
// without doubles: output_times and the end stand for a multiple within 1e-9 of the spacing.
std::vector<double> output_times(const scene::Run& run);

// What there is to tell of a state in which the mark passes.
KeyphasorPass keyphasor_pass(const Model& model, double t, const double* q, const double* v);

// What a step of an engine that knows its own works did.
struct StepFigures {
  double h = 0.0;               // s, what the impulses are for
  double normal_impulse = 0.0;  // N s, all of the step, with an impact's
  double friction_impulse = 0.0;
  double friction_work = 0.0;  // J, of friction between the surfaces
  double contact_work = 0.0;   // J, on the coordinates
  double external_work = 0.0;  // J, of all forces but springs and contact
  bool impact = false;         // the impulses are those of an impact
};

// The balance of the energy, as the engine knows it.
struct StepBalance {
  double energy = 0.0;         // J
  double contact_work = 0.0;   // J, on the coordinates, and
  double external_work = 0.0;  // J, of all forces but springs and contact, since the last step's
};

class Recorder {
 public:
  struct Span {
    double begin, end;  // s
  };
  // `times`: the rows wanted, ascending. `window`: s, see ImpulseWindow.
  Recorder(const Model& model, std::vector<double> times, double window = 0.0);

  void begin(const Snapshot& start);
  // One fixed step from the last snapshot to `now`; impulses over the step, N s, all of them,
  // with an impact's. `impact`: where velocities are not continuous within this step; friction
  // works at its own rates.
  void step(const Snapshot& now, double normal_impulse, double friction_impulse,
            const Impact* impact, const StepBalance& balance);
  // For engines that know their works: what was done, beginning at `begin` (s), and the next
  // snapshot. The energy is looked at now and then, as it costs a model evaluation.
  void count(const StepFigures& figures, double begin);
  // `point`: the contact of `now`, read where there is one. `impact`: as above, yes or no.
  void advance(const Snapshot& now, const ContactPoint& point, bool impact);
  // The actuator's part of a snapshot is only read where a row is due up to its time.
  bool row_due(double t) const { return next_time() <= t * (1.0 + 1e-9); }
  double penetration() const { return penetration_; }  // m, of the last snapshot, >= 0
  void add(const Impact& impact);
  void add(const Event& event);
  // What one of several contacts did over h (s) from `begin` (s) on, N s and J; and its gap at a
  // row or a step's end.
  void count_at(std::size_t contact, double begin, double h, double normal_impulse,
                double friction_impulse, double friction_work);
  void watch_gap(std::size_t contact, double gap);
  // In the figures of all what a further contact did over a step that step() counts; `before`: the
  // normal impulse of those before it.
  void count_beside(double begin, double h, double normal_impulse, double friction_impulse,
                    double friction_work, double before);
  // A soft contact from `begin` on that lasted so long, s: an impact within the window, else
  // lasting contact. Beside that of another contact an impact takes no time of its own.
  void count_episode(double begin, double lasted);
  // For engines with dense output of their own: the next wanted time (infinity: none left), a row
  // at exactly that time, and the statistics.
  double next_time() const;
  void row(const Snapshot& exact);
  Statistics& statistics() { return statistics_; }
  Keyphasor& keyphasor() { return keyphasor_; }
  // Of an engine that counts the contact itself: its impulse about the time t.
  void watch_impulse(double t, double impulse) { window_.add(t, impulse); }
  double window() const { return window_.width(); }

  // Ends the recording at time `end`; the recorder is empty afterwards.
  Trajectory finish(double end);

 private:
  void keep(const Snapshot& now, const ContactPoint& point);  // of the first contact
  void look_at_energy();
  void meet_energy(double now);
  void count_contact(double normal_impulse, double friction_impulse, double h, double begin,
                     bool impact);
  void count_gap(const ContactPoint& point, double h);
  void rows_until(const Snapshot& now, bool impact);
  void interpolate(const Snapshot& now, double share, bool impact);  // to q_, v_
  void passes_until(const Snapshot& now, bool impact);

  const Model* model_;
  std::vector<double> times_;
  std::size_t next_ = 0;
  double last_t_ = 0.0;  // s, of the last snapshot
  std::vector<double> last_q_, last_v_, q_, v_;
  double penetration_ = 0.0;
  // J: of a contact that rests at the last row its force over the clearance. A rotor at rest holds
  // no energy that round-off could be compared with.
  double resting_ = 0.0;
  std::int64_t steps_ = 0;
  double lasted_ = 0.0;     // s of lasting contact counted since the last snapshot
  double last_slip_ = 0.0;  // m/s
  std::vector<Column> columns_;
  std::vector<double> least_gaps_;  // m, of the rows, of each contact
  bool soft_ = false;               // several soft contacts have touched
  std::vector<Span> lasting_;       // of these, those that last
  std::vector<Impact> impacts_;
  std::vector<Event> events_;
  Statistics statistics_;
  ImpulseWindow window_;
  Keyphasor keyphasor_;
};

}  // namespace rotorub
