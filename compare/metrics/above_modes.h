// Where a rub excites the rotor above its highest kept bending mode. There the modal rotor has no
// flexibility of its own, and the effect of friction depends on the truncation and not on the
// shaft.
#pragma once

#include <optional>

#include "native_model/linear/campbell.h"
#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Highest whirl frequencies of the kept modes at the scene's spin speed, rad/s, > 0.
struct ModeBand {
  double forward = 0.0, backward = 0.0;
};
// For a rotor in geometry form with a contact; otherwise empty, because modal data count as the
// exact rotor.
std::optional<ModeBand> mode_band(const scene::Scene& scene);
// The band of these modes.
ModeBand mode_band(const WhirlSpectrum& spectrum);
// Whether a whirl at `rate` (rad/s, forward positive) is faster than all modes of its sense.
bool is_above(const ModeBand& band, double rate);

// Angular rate of the contact normal psi' = v_t / delta: v_t is the speed of the relative centre
// along e_t, delta its distance.
struct AboveModes {
  ModeBand band;
  double contact_share = 0.0;   // [0, 1], of the time in contact, with |psi'| above the band
  double friction_share = 0.0;  // [0, 1], of the friction work, with |psi'| above the band
  // rad/s, the psi' in contact with the largest absolute value, forward positive.
  double fastest = 0.0;
  // Whether the user should be told.
  bool matters() const { return contact_share > 0.01 || friction_share > 0.01; }
};

// Evaluated at the rows of the series, each weighted by half the time to its neighbours. Impacts
// take no time; they add their friction work at the psi' interpolated between the adjacent rows.
AboveModes above_modes(const Trajectory& trajectory, const ModeBand& band);

// Both steps; empty without a band.
std::optional<AboveModes> above_modes(const scene::Scene& scene, const Trajectory& trajectory);

}  // namespace rotorub
