// The steady free orbit, on which `[initial] steady` starts: the periodic response of rotor and
// ring to all loads that act at t = 0, without contact, with the controller off, at the spin speed
// Omega of t = 0. With q the bending coordinates of both planes (2 n),
//
//   M q'' + C q' + K q = w + sum_j Re(F_j e^{i nu_j t}),   q = K^-1 w + sum_j Re(Q_j e^{i nu_j t}),
//   (K - nu^2 M + i nu C) Q = F.
//
// C holds damping, the bearings' dampers, rotating damping and Omega G. K includes the circulatory
// part of rotating damping and the magnetic bearing. If the planes differ, one force excites both
// forward and backward whirl; the equations cover this. A force that rotates at nu (either sign) is
// F = A e^{i phase} (1, -i) at its station; unbalance has A = m e Omega^2 and nu = Omega. Weight
// and constant forces have nu = 0.
//
// The ring hangs in its spring under its weight and the pull of the actuator's magnets without a
// command; nothing else moves it. With a drive, the orbit is computed at constant speed, with
// torsion at rest under the motor's torque there (unless the scene sets it). A force counts if it
// acts in full at t = 0, a chirp with its frequency at that time. Pulses, and forces that begin to
// rise at t = 0 or later, are ignored.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "native_model/model/model.h"
#include "native_model/scene/forward.h"

namespace rotorub {

// Rest positions of a ring and its housing, m.
struct RingRest {
  Eigen::Vector2d ring{0.0, 0.0}, housing{0.0, 0.0};
};
// Throws scene::SceneError with key initial.steady if nothing holds the ring or its magnets pull it
// away from its centre.
RingRest ring_at_rest(const scene::Scene& scene, const Model& model, const AuxiliaryBearing& at);

// Words to follow a subject if an orbit needs more current than a magnetic bearing's limit; empty
// if it stays within the limit. The orbit is computed with the linear law. most: A, the sum of the
// amplitudes of all frequencies.
std::string beyond_limit(const scene::Scene& scene, const StationFeedback& feedback, double most);

// Largest distance between the rotor's centre and the ring's centre at a contact on the free orbit,
// even if it exceeds the clearance. Among all sets of loads that act together in full at some time,
// the set with the largest distance counts. Pulses are ignored.
struct FreeOrbit {
  std::optional<double> largest;  // m; empty if there is no such orbit
  std::string refused;            // reason, without a full stop
  double vibration = 0.0;         // m, peak to peak: largest motion of the centre about its mean
};

// Response to unbalance and all other loads at another spin speed (rad/s, either sign).
struct FreeResponse {
  std::vector<FreeOrbit> orbits;  // one per auxiliary bearing
  // One sentence, without a full stop, for each magnetic bearing whose current limit is exceeded,
  // so that the linear law behind the response does not hold.
  std::vector<std::string> notes;
};
FreeResponse free_response(const scene::Scene& scene, Model model, double speed);

}  // namespace rotorub
