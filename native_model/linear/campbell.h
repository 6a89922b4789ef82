// Whirl of the rotor at given spin speeds: the eigenvalues s of the damped gyroscopic system with
// circulatory terms (whirl_system.h), critical speeds, the threshold of stability and the curves of
// Campbell's diagram.
//
// Frequencies of the geometry form are those of the untruncated shaft; of each of its planes the
// `kept` lowest modes are shown. Small deflections, no contact.
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

// s of the mode x + i y ~ e^{s t} (forward: Im s > 0, backward: Im s < 0), and q' of it: isotropic
// planes: n, of x + i y; else 2 n, those of x before those of y, of the value of the complex pair
// with Im s > 0.
struct Whirl {
  std::complex<double> s;
  Eigen::VectorXcd rates;
};

// Two for each mode kept, those of least |s|; isotropic planes: as many forward as backward.
// Ordered by |Im s|, backward before forward where they are equal. Throws std::runtime_error where
// the iteration does not converge.
std::vector<Whirl> whirls(const WhirlSystem& system, double speed);
std::vector<std::complex<double>> whirl_eigenvalues(const WhirlSystem& system, double speed);

// By rising |frequency|; those of both senses that differ by round-off alone, as whirl at rest
// does, backward first, as it is at speed.
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
// fewer. Of the bearings only the stiffness that conserves energy is used: k_xx, k_yy and
// (k_xy + k_yx) / 2. If it depends on the speed, its value at the critical speed is used, so a mode
// may have no critical speed or several. The rest, (k_xy - k_yx) / 2, drives whirl; it is left out,
// as dampers are. sense: direction of the spin, +1 or -1; the speeds are absolute values.
// (critical_speeds.cc)
std::vector<double> critical_speeds(const WhirlSystem& system, double sense = 1.0);

// The sense of the orbit at each of these critical speeds; planar where nothing couples the planes.
enum class WhirlSense { kForward, kBackward, kPlanar };
const char* to_string(WhirlSense sense);  // "forward", "backward", "planar"
std::vector<WhirlSense> critical_senses(const WhirlSystem& system,
                                        const std::vector<double>& speeds, double sense = 1.0);

// Sizes of the spin speed (rad/s, >= 0) between which a kept mode grows, right to 1e-9 relative.
struct UnstableRange {
  double from;  // 0 where one grows at rest
  double to;    // infinite where one grows up to stability_bound
};
// Ascending, without overlap. sense: direction of the spin, +1 or -1. The search looks at every
// speed of the bearings' tables, at speeds where whirls cross, and between these: it halves an
// interval until its samples show that no mode's damping passes 0 inside. A stable range within an
// unstable one is found if it is wider than an eighth of its speed. (stability.cc)
std::vector<UnstableRange> unstable_ranges(const WhirlSystem& system, double sense = 1.0);
// Where the first of them begins; empty where there is none.
std::optional<double> stability_threshold(const WhirlSystem& system, double sense = 1.0);

// Up to where unstable_ranges looks, rad/s: 20 times the highest kept frequency at rest, and
// all of the bearings' tables. Infinite where nothing can grow: no internal damping, no film, and
// no magnetic bearing too strong.
double stability_bound(const WhirlSystem& system);

// Sizes of the speeds in that sense at which the bearings' tables have a point, rad/s, ascending, 0
// first.
std::vector<double> table_speeds(const WhirlSystem& system, double sense = 1.0);

// A curve of Campbell's diagram: one mode over a connected range of speeds. Where modes cross, each
// keeps to its own branch.
struct WhirlBranch {
  std::vector<double> speed;     // rad/s, ascending
  std::vector<WhirlMode> modes;  // at each speed
};

// speeds: rad/s, ascending and close: a mode is taken for the one whose frequency and growth
// continue those of the speeds before. Where none does (a mode comes into or leaves the kept ones,
// or two meet and are overdamped), a branch ends and another begins. By the |frequency| that each
// begins with.
// progress: given the share done in [0, 1] after each speed; may throw to stop.
// Throws std::runtime_error where the eigenvalues do not converge.
std::vector<WhirlBranch> whirl_branches(const WhirlSystem& system,
                                        const std::vector<double>& speeds,
                                        const std::function<void(double)>& progress = {});

// The system in so few of its leading coordinates (those of the lowest modes) that the kept modes
// at rest and at `speed` (rad/s) keep their s to `accuracy`, relative; many spectra then cost
// little.
WhirlSystem condensed(const WhirlSystem& system, double speed, double accuracy);

// 0 to highest in equal steps (rad/s, count >= 2 of them).
std::vector<double> even_speeds(double highest, int count);

}  // namespace rotorub
