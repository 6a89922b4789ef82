// Torsion of the shaft in geometry form: elastic modes of G I_p, rho I_p, the discs' J_p and the
// motor's rotor, and the inertia of the rigid spin.
#pragma once

#include "native_model/rotor/modal_rotor.h"
#include "native_model/scene/scene.h"

namespace rotorub {

// Shaft, discs and (with a drive) the motor's rotor: kg m^2.
double spin_inertia(const scene::Scene& scene);

// The modes asked for by [rotor.torsion], each 1 at the contact. With a drive: free-free, elastic
// ones alone, orthogonal to the rigid spin (which is in spin_inertia). Without: held at z = 0,
// where the motor sits by default. Empty without [rotor.torsion].
TorsionModes torsion_modes(const scene::Scene& scene);

}  // namespace rotorub
