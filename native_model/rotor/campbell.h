// Whirl of the rotor at given spin speeds: the eigenvalues s of the damped gyroscopic system with
// circulatory terms (whirl_system.h), critical speeds and the threshold of stability.
//
// Frequencies of the geometry form are those of the untruncated shaft; of each of its planes the
// `kept` lowest modes are shown. Small deflections, no contact.
#pragma once

#include <optional>
#include <vector>

#include "native_model/rotor/whirl_system.h"
#include "native_model/scene/scene.h"

namespace rotorub {

struct WhirlMode {
  // rad/s, Im s: forward whirl positive, backward negative, 0 where overdamped. For anisotropic
  // planes the sign is that of the angular momentum of the orbit; planar motion counts as forward,
  // but at rest the sign is that of the smallest spin.
  double frequency;
  double damping_ratio;  // -Re s / |s|, negative where unstable; 0 for s = 0
};

// Two modes for each one kept (isotropic planes: one forward, one backward), by rising |frequency|,
// backward before forward where they are equal.
struct WhirlSpectrum {
  double speed;  // rad/s
  std::vector<WhirlMode> modes;
};

// speed: rad/s, either sign. Throws RotorNotSolvable (refusal.h) where the eigenvalues do not converge.
WhirlSpectrum whirl_spectrum(const WhirlSystem& system, double speed);

// Undamped critical speeds (rad/s, ascending): whirl in step with the spin, K u = Omega^2 (1 - G)
// u. Isotropic planes: forward whirl alone, since unbalance cannot excite the other, at most
// `kept`; anisotropic: forward and backward, at most 2 `kept`. A rotor with a flat enough disc has
// fewer. Of bearings the springs k_xx and k_yy count, where they follow the speed those at the critical speed itself:
// it may cross its own curve at none or several. (critical_speeds.cc)
std::vector<double> critical_speeds(const WhirlSystem& system);

// The lowest spin speed >= 0 (rad/s) above which a kept mode grows, right to 1e-9 relative; 0 where
// one grows at rest. Empty where none grows up to stability_bound. The search steps by at most a
// quarter in speed: a window of instability narrower than a step may pass unseen.
std::optional<double> stability_threshold(const WhirlSystem& system);

// Up to where stability_threshold looks, rad/s: 20 times the highest kept frequency at rest.
// Infinite where nothing can grow: no internal damping, and no magnetic bearing too strong.
double stability_bound(const WhirlSystem& system);

}  // namespace rotorub
