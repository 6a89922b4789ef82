// What a shaft loses with the modes that are not kept, and how many of them are enough.
#pragma once

#include <functional>
#include <optional>

#include "native_model/rotor/rotor_modes.h"
#include "native_model/scene/forward.h"

namespace rotorub {

// What a rigid impact meets: the effective mass of the shaft at the contact, 1 / (u M^-1 u^T), u
// the mode values there. With more modes kept it falls without end unless a mass sits at the
// station (a sleeve): the largest impact falls with it, the mean force of a rub hardly does.
struct ContactMass {
  double kept = 0.0;  // kg, with the modes kept; the lighter plane's
  double mesh = 0.0;  // kg, with all modes of the mesh they were found on, <= kept
  int kept_modes = 0, mesh_modes = 0;
  // Impacts are those of the modes kept, not of the shaft.
  bool truncated() const { return kept > 1.1 * mesh; }
};

// Of a rotor in geometry form with a contact; otherwise none. Solves the shaft's eigenvalue
// problem.
std::optional<ContactMass> contact_mass(const scene::Scene& scene);

// [rotor] modes = "auto": as few bending modes as still tell what an impact and a static load meet.
// More modes than this are refused: a step that follows them is below 2 us on most shafts.
inline constexpr int kMostAutoModes = 50;

// The least number of modes n for which, on the mesh that n modes have, the first n modes are
// within the scene's modes_tolerance of all modes of that mesh, in both planes, in
//   - the effective mass at the contact, 1 / (u M^-1 u^T),
//   - the static flexibility u K^-1 u^T at contact, bearings, forces, magnetic bearings
//     and their sensors.
// `with_modes`: the shaft with n modes kept. Throws scene::SceneError where there is no such number
// up to kMostAutoModes: the effective mass of a station without a mass of its own falls without
// end.
RotorModes fewest_modes(const scene::Scene& scene,
                        const std::function<RotorModes(int)>& with_modes);

}  // namespace rotorub
