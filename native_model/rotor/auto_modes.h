// [rotor] modes = "auto": as few bending modes as still tell what an impact and a static load meet.
#pragma once

#include <functional>

#include "native_model/rotor/rotor_modes.h"
#include "native_model/scene/scene.h"

namespace rotorub {

// More modes than this are refused: a step that follows them is below 2 us on most shafts.
inline constexpr int kMostAutoModes = 50;

// The least number of modes n for which, on the mesh that n modes have, the first n modes are
// within the scene's modes_tolerance of all modes of that mesh, in both planes, in
//   - the effective mass at the contact, 1 / (u M^-1 u^T),
//   - the static flexibility u K^-1 u^T at contact, bearings, forces and magnetic bearing.
// `with_modes`: the shaft with n modes kept. Throws scene::SceneError where there is no such number
// up to kMostAutoModes: the effective mass of a station without a mass of its own falls without
// end.
RotorModes fewest_modes(const scene::Scene& scene,
                        const std::function<RotorModes(int)>& with_modes);

}  // namespace rotorub
