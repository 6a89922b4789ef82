// The shaft of the geometry form condensed to its kept planar modes: masses, stiffnesses, damping,
// gyroscopic terms and the mode values at the stations of the scene.
#pragma once

#include "native_model/rotor/modal_rotor.h"
#include "native_model/rotor/rotor_modes.h"
#include "native_model/scene/scene.h"

namespace rotorub {

// Everything of the ModalRotor that concerns bending. With Phi the scaled modes of each plane:
//   mass, stiffness   diagonals of Phi^T M Phi, Phi^T K Phi
//   damping           2 zeta sqrt(k m)
//   gyroscopic        Phi_x^T G Phi_y
//   internal_**       Phi_*^T D_i Phi_*, D_i the modal damping of the mean stiffness; for isotropic
//                     bearings exactly diagonal
ModalRotor reduce_bending(const scene::Scene& scene, const RotorModes& modes);

// Stations along the shaft, close enough to draw the kept modes and find their peaks (m,
// ascending).
std::vector<double> line_stations(const std::vector<ShaftElement>& mesh);

}  // namespace rotorub
