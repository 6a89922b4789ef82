// A start on a lasting rub, `[initial] rub`: rotor and ring on their circles, in contact,
//
//   r(0) = rho e^{i psi},  r'(0) = i nu rho e^{i psi},  z(0) = w e^{i psi},  z'(0) = i nu w e^{i
//   psi}
//
// rho, w, nu and psi those of steady_rub.h at the speed `rotor.speed` and the contact's friction:
// of several of the kind the first stable one, else the first (RubPoint::leading). Forces count
// where they act in full at t = 0, the controller where it is on then; what comes later finds the
// rotor on the rub. Whip and rolling leave the loads out, which make them beat.
//
// A ring that turns does so at the rub's speed. With a drive the rub is that of the speed held.
// Torsion rests under the motor's torque T and the friction's: K_k theta_k = d_k T - c_k r tau
// lambda (unless the scene gives it).
#pragma once

#include "native_model/model/model.h"
#include "native_model/scene/forward.h"

namespace rotorub::rub {

// Puts rotor and ring of the model on the rub; all else of it is as it will be. Throws
// scene::SceneError: as rub_system does; key initial.rub where there is no such rub, or loads of
// several frequencies; key controller.kind for `two_phase`, whose first phase is not that of the
// analysis; a force still rising at t = 0. Throws RotorNotSolvable (rotor/refusal.h).
void add_rub_start(const scene::Scene& scene, Model& model);

}  // namespace rotorub::rub
