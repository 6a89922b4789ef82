// Where a rub works faster than the rotor's highest kept bending mode: there the modal rotor has no
// flexibility of its own, and what friction drives is the truncation's, not the shaft's.
#pragma once

#include <optional>

#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Highest whirl frequencies of the kept modes at the scene's spin speed, rad/s, > 0.
struct ModeBand {
  double forward = 0.0, backward = 0.0;
};
// Of a rotor in geometry form with a contact; otherwise none: modal data are taken for the rotor.
std::optional<ModeBand> mode_band(const scene::Scene& scene);

// Turning rate of the contact normal psi' = v_t / delta, v_t the speed of the relative centre along
// e_t, delta its distance.
struct AboveModes {
  ModeBand band;
  double contact_share = 0.0;   // [0, 1], of the time in contact, with |psi'| above the band
  double friction_share = 0.0;  // [0, 1], of the friction work, with |psi'| above the band
  double fastest = 0.0;         // rad/s, the psi' in contact of largest size, forward positive
  // Worth a word to the user.
  bool matters() const { return contact_share > 0.01 || friction_share > 0.01; }
};

// By the rows of the series, each standing for half the time to its neighbours; impacts, which
// take no time, add their friction work at the psi' between the rows around them.
AboveModes above_modes(const Trajectory& trajectory, const ModeBand& band);

// Both; none where there is no band.
std::optional<AboveModes> above_modes(const scene::Scene& scene, const Trajectory& trajectory);

}  // namespace rotorub
