// Steady response to unbalance over the spin speed, without contact: the data of Bode and polar
// plots, and the amplification factors of API 684.
//
// A probe at a station measures d(t) = Re(X e^{i |Omega| t}); at t = 0 the mark on the rotor passes
// the probe. |X| is the amplitude and arg X the phase, negative if the high spot lags behind the
// mark. For a rotor with one mode and unbalance m e:
//
//   X = e r^2 / (1 - r^2 + 2 i zeta r),   r = Omega / omega.
#pragma once

#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "native_model/scene/forward.h"

namespace rotorub {

// A peak of the response, that is, a critical speed as it appears in operation, with its
// amplification factor
//   AF = N / (N_2 - N_1),   |X| = peak / sqrt 2 at N_1 < N < N_2,
// which is about 1 / (2 zeta). A peak with AF < 2.5 is critically damped. (API RP 684, 3rd ed.,
// 2.4)
struct ResponsePeak {
  double speed = 0.0;                     // rad/s, absolute value
  std::complex<double> deflection;        // m
  std::optional<double> amplification{};  // empty: |X| does not fall that far on both sides
};

// Required separation of an operating speed from such a peak, as a fraction of that speed (API 617,
// 8th ed., 1-6.8.2.10): 0.17 (1 - 1 / (AF - 1.5)), plus 0.1 for a peak above it; empty if AF < 2.5.
std::optional<double> required_margin(double amplification, bool above);

struct ProbeResponse {
  std::string name;  // of the station
  int plane = 0;     // 0: x, 1: y
  // m, at each speed; NaN if there is no steady motion (unstable, or an undamped resonance).
  std::vector<std::complex<double>> deflection;
  std::vector<ResponsePeak> peaks;
};

// Response of the kept modes. Forces that rotate with the spin at the scene's speed count as the
// equivalent unbalance, amplitude / speed^2.
struct SynchronousResponse {
  std::vector<double> speed;  // rad/s, absolute values, ascending; the spin has the scene's sense
  std::vector<ProbeResponse> probes;
  bool forces = false;      // whether forces count beside unbalance
  bool same_planes = true;  // if true, there are only probes of x
};

// Response up to `top` (rad/s), with speeds so close, the scene's own among them, that linear
// interpolation of every probe is accurate to 0.3 %. Magnetic bearings work as in levitation.h.
// Empty if nothing rotates with the spin, or if there is no steady motion at any speed, for example
// because the law of a magnetic bearing is not known. The stations are discs, bearings, contacts,
// magnetic bearings and their sensors; the modal form has only the last three.
std::optional<SynchronousResponse> synchronous_response(const scene::Scene& scene, double top);

}  // namespace rotorub
