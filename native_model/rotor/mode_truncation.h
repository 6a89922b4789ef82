// Effect of the modes that are not kept, and the number of modes that is enough.
#pragma once

#include <functional>
#include <optional>

#include "native_model/rotor/rotor_modes.h"
#include "native_model/scene/forward.h"

namespace rotorub {

// Effective mass of the shaft at a contact in a rigid impact, 1 / (u M^-1 u^T), with u the mode
// values there. It falls without limit as more modes are kept, unless there is a mass at the
// station (a sleeve). The largest impact falls with it; the mean force of a rub hardly changes.
struct ContactMass {
  double kept = 0.0;  // kg, with the kept modes, in the plane where it is smaller
  double mesh = 0.0;  // kg, with all modes of the mesh on which they were computed, <= kept
  int kept_modes = 0, mesh_modes = 0;
  // 1, kept mass over mass of the shaft.
  double ratio() const { return kept / mesh; }
  // If true, the impacts depend on the number of kept modes and not only on the shaft.
  bool truncated() const { return kept > 1.1 * mesh; }
};

// The effective mass at the contact, with several contacts at the one with the largest ratio().
// Empty unless the rotor is in geometry form and has a contact. Solves the shaft's eigenvalue
// problem.
std::optional<ContactMass> contact_mass(const scene::Scene& scene);

// Limit for [rotor] modes = "auto", which keeps the fewest bending modes that give the right
// effective mass and static flexibility. More modes are refused: on most shafts they would need a
// time step below 2 us.
inline constexpr int kMostAutoModes = 50;

// Finds the least n for which the first n modes agree with all modes of the mesh made for n modes.
// The tolerance is the scene's modes_tolerance, and in both planes it applies to
//   - the effective mass at each contact, 1 / (u M^-1 u^T),
//   - the static flexibility u K^-1 u^T at contacts, bearings, forces, magnetic bearings
//     and their sensors.
// with_modes(n) returns the shaft with n modes kept. Throws scene::SceneError if no n up to
// kMostAutoModes is enough. This happens at a contact without a mass of its own, where the
// effective mass falls without limit.
RotorModes fewest_modes(const scene::Scene& scene,
                        const std::function<RotorModes(int)>& with_modes);

}  // namespace rotorub
