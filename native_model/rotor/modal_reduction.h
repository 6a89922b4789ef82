// The shaft of the geometry form condensed to its kept planar modes: masses, stiffnesses, damping,
// gyroscopic terms and the mode values at the stations of the scene.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "native_model/rotor/modal_rotor.h"
#include "native_model/rotor/rotor_modes.h"
#include "native_model/scene/forward.h"

namespace rotorub {

// The amplitude of a mode: 1 at the contact, so that the deflection there is the plain sum of the
// modal coordinates (design section 2, Scaling).
struct ModeScale {
  double factor;   // multiplies the mode
  double contact;  // 1, mode value at the contact after scaling: exactly 1, or 0 for a node there
};

// value(z): the unscaled mode along the shaft. Scaled to 1 at `contact` (m); where the mode has a
// node there (below 1e-6 of its largest value), and where there is no contact, to 1 at the largest
// value among `stations` (m, ascending) and the peaks between them; of several equally large ones
// the first. Without a contact the value there counts as 1.
ModeScale mode_scale(const std::function<double(double)>& value,
                     const std::vector<double>& stations, std::optional<double> contact);

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
