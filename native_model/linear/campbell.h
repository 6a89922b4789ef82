// Whirl of the rotor at given spin speeds: the eigenvalues s of the damped gyroscopic system with
// circulatory terms (whirl_system.h), critical speeds, the stability threshold and the curves of
// the Campbell diagram.
//
// For the geometry form the frequencies belong to the untruncated shaft; only the `kept` lowest
// modes of each plane are returned. Deflections are small and there is no contact.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "native_model/linear/whirl_system.h"

namespace rotorub {

// Eigenvalue s of the mode x + i y ~ e^{s t} (Im s > 0 forward, Im s < 0 backward) and its q'. With
// isotropic planes, q' has n entries, for x + i y. Otherwise it has 2 n, x before y, and belongs to
// the member of the complex pair with Im s > 0.
struct Whirl {
  std::complex<double> s;
  Eigen::VectorXcd rates;
};

// The two modes with the smallest |s| for each kept mode; with isotropic planes, as many forward as
// backward. They are ordered by |Im s|, backward before forward where equal. Throws
// RotorNotSolvable (refusal.h) if the iteration does not converge.
std::vector<Whirl> whirls(const WhirlSystem& system, double speed);
std::vector<std::complex<double>> whirl_eigenvalues(const WhirlSystem& system, double speed);

// Sorts by rising |frequency|. Two modes of opposite sense whose frequencies differ only by
// round-off, as at rest, are ordered backward first, as they would be at speed.
template <typename T, typename Frequency>
void sort_by_frequency(std::vector<T>& all, const Frequency& frequency) {
  constexpr double kEqual = 1e-9;
  std::sort(all.begin(), all.end(), [&](const T& a, const T& b) {
    return std::abs(frequency(a)) < std::abs(frequency(b));
  });
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    const double first = frequency(all[i]), second = frequency(all[i + 1]);
    const bool equal = std::abs(second) - std::abs(first) <= kEqual * std::abs(first);
    if (equal && first > 0.0 && second < 0.0) std::swap(all[i], all[i + 1]);
  }
}

struct WhirlMode {
  // rad/s, Im s: positive for forward whirl, negative for backward whirl, 0 if overdamped. With
  // anisotropic planes the sign is that of the orbit's angular momentum. Planar motion counts as
  // forward, except at rest, where the sign is taken at a very small spin.
  double frequency;
  double damping_ratio;  // -Re s / |s|, negative if unstable; 0 for s = 0
};

// Two modes for each kept mode (with isotropic planes, one forward and one backward), by rising
// |frequency|, backward before forward where equal.
struct WhirlSpectrum {
  double speed;  // rad/s
  std::vector<WhirlMode> modes;
};

// speed: rad/s, either sign. Throws RotorNotSolvable if the eigenvalues do not converge.
WhirlSpectrum whirl_spectrum(const WhirlSystem& system, double speed);

// Undamped critical speeds (rad/s, ascending), where a whirl is synchronous with the spin:
// K u = Omega^2 (1 - G) u. With isotropic planes only forward whirl counts, since unbalance cannot
// excite backward whirl, and there are at most `kept` speeds. With anisotropic planes both senses
// count, at most 2 `kept`. A rotor with a flat enough disc has fewer. Only the conservative
// stiffness of the bearings is used: k_xx, k_yy and (k_xy + k_yx) / 2. The rest, (k_xy - k_yx) / 2,
// drives whirl and is left out, like the dampers. If the stiffness depends on the speed, its value
// at the critical speed is used, so a mode may have no critical speed or several. sense: direction
// of the spin, +1 or -1; the returned speeds are absolute values. (critical_speeds.cc)
std::vector<double> critical_speeds(const WhirlSystem& system, double sense = 1.0);

// Sense of the orbit at each of these critical speeds; planar if nothing couples the planes.
enum class WhirlSense { kForward, kBackward, kPlanar };
const char* to_string(WhirlSense sense);  // "forward", "backward", "planar"
std::vector<WhirlSense> critical_senses(const WhirlSystem& system,
                                        const std::vector<double>& speeds, double sense = 1.0);

// A range of spin speeds (rad/s, absolute values) in which a kept mode grows; the ends are accurate
// to 1e-9 relative.
struct UnstableRange {
  double from;  // 0 if a mode grows at rest
  double to;    // infinite if a mode still grows at stability_bound
};
// Unstable ranges, ascending and without overlap. sense: direction of the spin, +1 or -1. The
// search samples every speed in the bearings' tables and the speeds where whirls cross. It halves
// each interval until the samples show that no mode's damping passes through 0 inside. It finds a
// stable range within an unstable one if that range is wider than a sixth of its speed.
// (stability.cc)
std::vector<UnstableRange> unstable_ranges(const WhirlSystem& system, double sense = 1.0);
// Start of the first unstable range; empty if there is none.
std::optional<double> stability_threshold(const WhirlSystem& system, double sense = 1.0);

// The speed up to which unstable_ranges searches, rad/s: 20 times the highest kept frequency at
// rest, or the highest speed in the bearings' tables if that is larger. Infinite if nothing can
// grow, that is, without internal damping, bearing films and magnetic bearings of net negative
// stiffness.
double stability_bound(const WhirlSystem& system);

// Absolute speeds of the points in the bearings' tables for that sense of spin, rad/s: 0, then
// ascending.
std::vector<double> table_speeds(const WhirlSystem& system, double sense = 1.0);

// A curve of the Campbell diagram: one mode over a connected range of speeds. Where modes cross,
// each follows its own branch.
struct WhirlBranch {
  std::vector<double> speed;     // rad/s, ascending
  std::vector<WhirlMode> modes;  // at each speed
};

// speeds: rad/s, ascending and closely spaced. A mode continues the branch whose frequency and
// growth it extrapolates best. If it continues none (a mode enters or leaves the kept ones, or two
// meet and become overdamped), a branch ends and another begins. Branches are ordered by the
// |frequency| at their first speed. progress is called with the fraction done in [0, 1] after each
// speed and may throw to stop. Throws RotorNotSolvable if the eigenvalues do not converge.
std::vector<WhirlBranch> whirl_branches(const WhirlSystem& system,
                                        const std::vector<double>& speeds,
                                        const std::function<void(double)>& progress = {});

// Reduces the system to its leading coordinates (the lowest modes), as few as keep s of the kept
// modes at rest and at `speed` (rad/s) within the relative `accuracy`. Many spectra then cost
// little.
WhirlSystem condensed(const WhirlSystem& system, double speed, double accuracy);

// `count` >= 2 equally spaced speeds from 0 to `highest` (rad/s).
std::vector<double> even_speeds(double highest, int count);

}  // namespace rotorub
