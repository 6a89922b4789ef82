// One impact, as results list it.
#pragma once

namespace rotorub {

// What is known of an impact, or with a soft contact of an episode of contact. Impulses on the
// rotor: normal >= 0, tangential signed along e_t. Speeds: gap rate (negative closing) and slip
// gdot_T.
struct Impact {
  double t = 0.0;                                       // s
  double normal_impulse = 0.0, friction_impulse = 0.0;  // N s
  double gap_rate_before = 0.0, gap_rate_after = 0.0;   // m/s
  double slip_before = 0.0, slip_after = 0.0;           // m/s
  // J, of the system by this contact; over those of one instant the sum is <= 0.
  double energy_change = 0.0;
  int contact = 0;  // which of several, from 0
};
inline constexpr double kCountedGapRate = -1e-4;  // m/s: an impact counts below this
inline bool counts(const Impact& impact) { return impact.gap_rate_before < kCountedGapRate; }

}  // namespace rotorub
