// The figures of one run: functions only of its Trajectory and of the contact's constants.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "compare/metrics/attractor.h"
#include "compare/metrics/residuals.h"
#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// "From first touch" means from Statistics::first_touch to the end; without a touch these figures
// are 0. Forces are averages over one step (impulse of the step / step), so that an impact counts
// with its whole impulse. Peak and scatter of a run with impacts therefore grow as the step
// shrinks.
struct Metrics {
  std::optional<double> first_touch;  // s
  // m, smallest gap: 0 if the rotor touched within a step, < 0 for penetration.
  std::optional<double> least_gap;
  double mean_force = 0.0;        // N, normal impulse / time from first touch
  double force_deviation = 0.0;   // N, standard deviation over the time from first touch
  double peak_force = 0.0;        // N
  double contact_fraction = 0.0;  // [0, 1], of the time from first touch
  double lasting_fraction = 0.0;  // [0, 1], the same without impacts (Statistics::impact_time)
  double impulse_total = 0.0;     // N s, normal
  double friction_impulse = 0.0;  // N s, signed along e_t
  double friction_work = 0.0;     // J, <= 0
  std::size_t impacts = 0;        // counted ones (closing faster than 1e-4 m/s)
  std::size_t hard_impacts = 0;   // counted impacts faster than kHardShare of the fastest
  double peak_impulse = 0.0;      // N s, of the largest impact
  // N s, the same for a rigid law; empty for a soft contact, which has episodes instead of impacts.
  std::optional<double> impact_impulse;
  // N s, largest within the window (recorder.h); empty for MuJoCo with a rigid law.
  std::optional<double> window_impulse;
  double gap_rate_rms = 0.0;     // m/s, from first touch
  double max_penetration = 0.0;  // m
  double rms_penetration = 0.0;  // m, over the time from first touch
  // For compliant contacts, where they are meaningful: the largest force (N), the largest depth
  // (m), and the time in contact (s).
  std::optional<double> contact_peak, contact_depth, contact_time;
  // Only for a single run: full_passes.h.
  std::optional<int> forward_passes, backward_passes;
  std::optional<double> whirl_time;  // s
  // m, (v_t dt)^2 / (2 delta_0), v_t the rms speed of the relative centre along e_t over the rows
  // in contact.
  double whirl_penetration = 0.0;
  double energy_residual = 0.0;  // dimensionless, |E_end - E_start - work| / largest energy
  Settled settled;
  // Mean over the last fifth of the run, rad/s, if the speed is free.
  std::optional<double> spin_speed, ring_speed;
  std::optional<double>
      control_force;  // N, rms force on the ring over the run; empty without an actuator
  Residuals residuals;
  double end = 0.0;   // s, time reached
  double step = 0.0;  // s; 0 for `event`
  // Cost.
  std::int64_t steps = 0;
  double wall_s = 0.0;            // s, of the integration
  double us_per_step = 0.0;       // 0 without a step
  double real_time_factor = 0.0;  // simulated time / wall time
};

// Accumulating impacts have no meaningful count, because the last bounces last less than a step.
// Impacts faster than this share of the fastest one are resolved by every reasonable step.
inline constexpr double kHardShare = 0.01;

// One per contact; empty if the scene has none.
std::vector<ContactFacts> contact_facts(const scene::Scene& scene);

// The metrics that need neither the series nor the contacts.
Metrics totals(const Trajectory& trajectory);

// The penetration of a run that is deepest relative to the clearance of its contact.
struct DeepestPenetration {
  std::size_t contact = 0;  // index
  double depth = 0.0;       // m
  double share = 0.0;       // of the contact's clearance
};
// contacts: of the run's scene, at least one.
DeepestPenetration deepest_penetration(const Statistics& statistics,
                                       const std::vector<ContactFacts>& contacts);

// All metrics; without `contacts` those that depend on them are missing.
Metrics metrics(const Trajectory& trajectory, const std::vector<ContactFacts>& contacts);

}  // namespace rotorub
