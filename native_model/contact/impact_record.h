// One impact, as results list it.
#pragma once

namespace rotorub {

// The record of an impact, or of a whole episode of contact if the contact is soft. Impulses act on
// the rotor: normal >= 0, friction positive along e_t. Speeds: gap rate (negative when closing) and
// slip gdot_T.
struct Impact {
  double t = 0.0;                                       // s
  double normal_impulse = 0.0, friction_impulse = 0.0;  // N s
  double gap_rate_before = 0.0, gap_rate_after = 0.0;   // m/s
  double slip_before = 0.0, slip_after = 0.0;           // m/s
  // J, change of the system's energy by this contact; the sum over all contacts of one instant is
  // <= 0.
  double energy_change = 0.0;
  int contact = 0;  // index of the contact, from 0
};
// m/s; an impact counts if its gap rate before is below this.
inline constexpr double kCountedGapRate = -1e-4;
inline bool counts(const Impact& impact) { return impact.gap_rate_before < kCountedGapRate; }

}  // namespace rotorub
