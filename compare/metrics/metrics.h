// The figures of one run: functions of its Trajectory alone (and of the contact's constants).
#pragma once

#include <optional>

#include "compare/metrics/attractor.h"
#include "compare/metrics/residuals.h"
#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// "From first touch" is from Statistics::first_touch to the end; all of those are 0 without one.
// Forces are averages over one step (impulse of the step / step), so that an impact counts with its
// whole impulse: peak and scatter of a run with impacts therefore grow as the step shrinks.
struct Metrics {
  std::optional<double> first_touch;  // s
  // m, how near the rotor came: 0 where it touched within a step, < 0 penetration.
  std::optional<double> least_gap;
  double mean_force = 0.0;               // N, normal impulse / time from first touch
  double force_deviation = 0.0;          // N, standard deviation over the time from first touch
  double peak_force = 0.0;               // N
  double contact_fraction = 0.0;         // [0, 1], of the time from first touch
  double lasting_fraction = 0.0;         // [0, 1], of it without impacts (Statistics::impact_time)
  double impulse_total = 0.0;            // N s, normal
  double friction_impulse = 0.0;         // N s, signed along e_t
  double friction_work = 0.0;            // J, <= 0
  std::size_t impacts = 0;               // counted ones (closing faster than 1e-4 m/s)
  std::size_t hard_impacts = 0;          // of these, faster than kHardShare of the fastest
  double peak_impulse = 0.0;             // N s, largest of one impact
  std::optional<double> impact_impulse;  // N s, the same under a rigid law; none: a soft contact
                                         // has episodes, and no impacts
  std::optional<double> window_impulse;  // N s, largest within the window (recorder.h); none:
                                         // MuJoCo under a rigid law
  double gap_rate_rms = 0.0;             // m/s, from first touch
  double max_penetration = 0.0;          // m
  double rms_penetration = 0.0;          // m, over the time from first touch
  // Of contacts that give, with whom they mean something: the largest force (N) and depth (m), and
  // the time in contact (s).
  std::optional<double> contact_peak, contact_depth, contact_time;
  // Of a run by itself: full_passes.h.
  std::optional<int> forward_passes, backward_passes;
  std::optional<double> whirl_time;  // s
  double whirl_penetration = 0.0;    // m, (v_t dt)^2 / (2 delta_0), v_t the rms speed of the
                                     // relative centre along e_t over the rows in contact
  double energy_residual = 0.0;      // 1, |E_end - E_start - work| / largest energy
  Settled settled;
  // Where they are free: over the last fifth of the run, rad/s.
  std::optional<double> spin_speed, ring_speed;
  std::optional<double>
      control_force;  // N, rms of what acts on the ring over the run; none: no actuator
  Residuals residuals;
  double end = 0.0;   // s, time reached
  double step = 0.0;  // s; `event`: 0
  // Cost.
  std::int64_t steps = 0;
  double wall_s = 0.0;            // of the integration
  double us_per_step = 0.0;       // 0 for no step
  double real_time_factor = 0.0;  // simulated time / wall time
};

// An accumulation of impacts has no number: the last bounces last less than a step. Those faster
// than this share of the fastest one are distinguished by every step that is worth anything.
inline constexpr double kHardShare = 0.01;

// Of each contact; empty where the scene has none.
std::vector<ContactFacts> contact_facts(const scene::Scene& scene);

// Of the metrics those that need neither the series nor the contacts.
Metrics totals(const Trajectory& trajectory);

// All; without `contacts` nothing that needs to know them.
Metrics metrics(const Trajectory& trajectory, const std::vector<ContactFacts>& contacts);

}  // namespace rotorub
