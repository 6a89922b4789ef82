// The steady answer to unbalance over the spin speed, without contact: what Bode and polar plots of
// rotor dynamics show, and the amplification factors of API 684.
//
// A probe at a station sees d(t) = Re(X e^{i |Omega| t}); t = 0: the mark on the rotor lies under
// the probe. |X| is the amplitude, arg X the phase, negative where the high spot lags behind the
// mark. The rotor in one mode with unbalance m e:
//
//   X = e r^2 / (1 - r^2 + 2 i zeta r),   r = Omega / omega.
#pragma once

#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "native_model/scene/forward.h"

namespace rotorub {

// A peak of the response: a critical speed as it is felt, with its amplification factor
//   AF = N / (N_2 - N_1),   |X| = peak / sqrt 2 at N_1 < N < N_2,
// about 1 / (2 zeta); one below 2.5 is critically damped. (API RP 684, 3rd ed., 2.4)
struct ResponsePeak {
  double speed = 0.0;                     // rad/s, size
  std::complex<double> deflection;        // m
  std::optional<double> amplification{};  // none: it does not fall that far on either side
};

// How far a speed of the machine has to lie from such a peak, as a share of that speed (API 617,
// 8th ed., 1-6.8.2.10): 17 % (1 - 1 / (AF - 1.5)), and 10 % more of a peak above it; none where AF
// < 2.5.
std::optional<double> required_margin(double amplification, bool above);

struct ProbeResponse {
  std::string name;  // of the station
  int plane = 0;     // 0: x, 1: y
  // m, at each speed; NaN where there is no steady motion: unstable, or undamped in resonance.
  std::vector<std::complex<double>> deflection;
  std::vector<ResponsePeak> peaks;
};

// Of the modes kept. Forces that turn with the spin at the scene's speed count as the unbalance
// that they are there, amplitude / speed^2.
struct SynchronousResponse {
  std::vector<double> speed;  // rad/s, sizes, ascending, of a spin of the scene's sense
  std::vector<ProbeResponse> probes;
  bool forces = false;      // forces count beside unbalance
  bool same_planes = true;  // then probes of x alone
};

// Up to `top` (rad/s), so closely that straight lines between the speeds are right to 0.3 % of
// every probe, the scene's own among them. Magnetic bearings work as in levitation.h. Empty:
// nothing turns with the spin, or their law is not known, or there is nothing steady at any speed.
// Stations: discs, bearings, contacts, magnetic bearings and their sensors; of the modal form the
// last three.
std::optional<SynchronousResponse> synchronous_response(const scene::Scene& scene, double top);

}  // namespace rotorub
