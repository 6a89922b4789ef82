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

// speed: rad/s, either sign. Throws RotorNotSolvable (refusal.h) where the eigenvalues do not
// converge.
WhirlSpectrum whirl_spectrum(const WhirlSystem& system, double speed);

// Undamped critical speeds (rad/s, ascending): whirl in step with the spin, K u = Omega^2 (1 - G)
// u. Isotropic planes: forward whirl alone, since unbalance cannot excite the other, at most
// `kept`; anisotropic: forward and backward, at most 2 `kept`. A rotor with a flat enough disc has
// fewer. Of bearings the springs k_xx and k_yy count, where they follow the speed those at the
// critical speed itself: it may cross its own curve at none or several. (critical_speeds.cc) sense:
// of the spin, +1 or -1, of which the sizes are given.
std::vector<double> critical_speeds(const WhirlSystem& system, double sense = 1.0);

// The lowest size of the spin speed (rad/s, >= 0) above which a kept mode grows, right to 1e-9
// relative; 0 where one grows at rest; sense: of the spin, +1 or -1. Empty where none grows up to
// stability_bound. Windows of instability are looked for at every speed of the bearings' tables,
// where whirls cross, and between: an interval is halved until no mode's damping can come to 0
// inside, as its course there tells. (stability.cc)
std::optional<double> stability_threshold(const WhirlSystem& system, double sense = 1.0);

// Up to where stability_threshold looks, rad/s: 20 times the highest kept frequency at rest, and
// all of the bearings' tables. Infinite where nothing can grow: no internal damping, no film, and
// no magnetic bearing too strong.
double stability_bound(const WhirlSystem& system);

// Sizes of the speeds in that sense at which the bearings' tables have a point, rad/s, ascending, 0
// first.
std::vector<double> table_speeds(const WhirlSystem& system, double sense = 1.0);

}  // namespace rotorub
