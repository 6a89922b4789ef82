// A start on a lasting rub, `[initial] rub`. In a machine that looks the same from all directions,
// rotor and ring move on their circles, in contact,
//
//   r(0) = rho e^{i psi},  r'(0) = i nu rho e^{i psi},
//   z(0) = w e^{i psi},    z'(0) = i nu w e^{i psi}.
//
// steady_rub.h defines rho, w, nu and psi, here at the speed `rotor.speed` and the contact's
// friction. If several rubs of the kind exist, the first stable one is taken, else the first
// (RubPoint::leading). Only forces that act in full at t = 0 count, and the controller only if it
// is on then; whatever begins later finds the rotor on the rub. Whip and rolling leave out the
// loads, which will make them beat.
//
// A ring that turns starts at the rub's speed. With a drive, the rub is computed at constant spin
// speed. Torsion is at rest under the motor's torque T and the friction torque,
// K_k theta_k = d_k T - c_k r tau lambda, unless the scene sets it.
#pragma once

#include "native_model/model/model.h"
#include "native_model/scene/forward.h"

namespace rotorub::rub {

// Puts rotor and ring of the model on the rub; the rest of the model must be complete. Where the
// closed form does not hold (rub_system), the start lies on a periodic rub of the same kind that
// shooting finds (periodic_start.h). Throws scene::SceneError as rub_system does if there is none;
// with key initial.rub if there is no such rub or there are loads of several frequencies; with key
// controller.kind for `two_phase`, whose first phase is not covered by the analysis; and for a
// force that is still rising at t = 0. Throws RotorNotSolvable (rotor/refusal.h).
void add_rub_start(const scene::Scene& scene, Model& model);

// The same by the closed form alone.
void put_on_closed_form(const scene::Scene& scene, Model& model);

}  // namespace rotorub::rub
