// Reduces the shaft in geometry form to its kept planar modes: masses, stiffnesses, damping,
// gyroscopic terms, and the mode values at the stations of the scene.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "native_model/rotor/modal_rotor.h"
#include "native_model/rotor/rotor_modes.h"
#include "native_model/scene/forward.h"

namespace rotorub {

// Scaling of one mode to 1 at the contact. The deflection there is then the plain sum of the modal
// coordinates (design section 2, Scaling).
struct ModeScale {
  double factor;   // multiplies the mode
  double contact;  // 1, mode value at the contact after scaling: exactly 1, or 0 for a node there
};

// value(z) is the unscaled mode along the shaft. It is scaled to 1 at `contact` (m). If the mode
// has a node there (less than 1e-6 of its largest value), or if there is no contact, it is scaled
// to 1 at its largest value among `stations` (m, ascending) and the peaks between them; the first
// of several equally large peaks is used. Without a contact, the result's `contact` is 1.
ModeScale mode_scale(const std::function<double(double)>& value,
                     const std::vector<double>& stations, std::optional<double> contact);

// Computes all bending terms of the ModalRotor. With Phi the scaled modes of each plane:
//   mass, stiffness   diagonals of Phi^T M Phi, Phi^T K Phi
//   damping           2 zeta sqrt(k m)
//   gyroscopic        Phi_x^T G Phi_y
//   internal_**       Phi_*^T D_i Phi_*, where D_i is the modal damping of the modes of the mean
//                     stiffness; exactly diagonal for isotropic bearings
// If magnetic bearings hold the shaft, both dampings use the modes without their springs
// (OwnModes); the external one is then stored as dashpots in `bearing_dampers`.
ModalRotor reduce_bending(const scene::Scene& scene, const RotorModes& modes);

// m, station of the first contact; empty without one.
std::optional<double> contact_station(const scene::Scene& scene);

// Stations along the shaft (m, ascending), close enough to draw the kept modes and to find their
// peaks.
std::vector<double> line_stations(const std::vector<ShaftElement>& mesh);

}  // namespace rotorub
