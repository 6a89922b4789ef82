// The steady free orbit, on which `[initial] steady` starts: the periodic answer of rotor and ring
// to all that acts at t = 0, without contact, the controller off, at the spin speed Omega of t = 0.
// With q the bending coordinates of both planes (2 n),
//
//   M q'' + C q' + K q = w + sum_j Re(F_j e^{i nu_j t}),   q = K^-1 w + sum_j Re(Q_j e^{i nu_j t}),
//   (K - nu^2 M + i nu C) Q = F,
//
// C: damping, bearings' dampers, rotating damping, Omega G; K: with the circulatory part of
// rotating damping and the magnetic bearing. Planes that differ make forward and backward parts of
// one force; they come by themselves. A force that turns at nu, either sign: F = A e^{i phase} (1,
// -i) through its station, unbalance with A = m e Omega^2 at nu = Omega. Weight and constant
// forces: nu = 0.
//
// The ring hangs in its spring under weight and the pull of magnets without a command; nothing else
// moves it. With a drive the orbit is that of the speed held, torsion at rest under the motor's
// torque there (unless the scene gives it). Forces count where they act in full at t = 0, a chirp
// by its frequency then; one that begins to rise, and a pulse, come later.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "native_model/model/model.h"
#include "native_model/scene/forward.h"

namespace rotorub {

// Where a ring and its housing come to rest, m.
struct RingRest {
  Eigen::Vector2d ring{0.0, 0.0}, housing{0.0, 0.0};
};
// Throws scene::SceneError, key initial.steady, where nothing holds the ring or its magnets pull it
// away.
RingRest ring_at_rest(const scene::Scene& scene, const Model& model, const AuxiliaryBearing& at);

// Words to go after a subject where an orbit asks a magnetic bearing for more than its limit; empty
// where it keeps the limit. The orbit is that of the linear law. most: A, the sum of the amplitudes
// of all frequencies.
std::string beyond_limit(const scene::Scene& scene, const StationFeedback& feedback, double most);

// How far the rotor's centre goes from the ring's at a contact on that orbit, whether it would
// touch or not, of all sets of loads that come to act together in full by the one that takes it
// furthest. A pulse passes and counts for nothing.
struct FreeOrbit {
  std::optional<double> largest;  // m; empty: there is no such orbit
  std::string refused;            // why, without a full stop
  double vibration = 0.0;         // m, peak to peak: the most that the centre moves about its mean
};

// The response to unbalance and all else that acts at another spin speed (rad/s, either sign).
struct FreeResponse {
  std::vector<FreeOrbit> orbits;  // at each auxiliary bearing
  // Where a magnetic bearing is asked for more than its current limit, and the law that the
  // response is of does not hold: a sentence each, without a full stop.
  std::vector<std::string> notes;
};
FreeResponse free_response(const scene::Scene& scene, Model model, double speed);

}  // namespace rotorub
