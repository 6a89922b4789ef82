// The Campbell diagram's curves: whirl spectra over a range of spin speeds, joined to branches that
// each follow one mode.
#pragma once

#include <functional>
#include <vector>

#include "native_model/rotor/campbell.h"

namespace rotorub {

// One mode over a connected range of speeds. Where modes cross, each keeps to its own branch.
struct WhirlBranch {
  std::vector<double> speed;     // rad/s, ascending
  std::vector<WhirlMode> modes;  // at each speed
};

// speeds: rad/s, ascending and close: a mode is taken for the one whose frequency and growth
// continue those of the speeds before. Where none does (a mode comes into or leaves the kept ones,
// or two meet and are overdamped), a branch ends and another begins. By the |frequency| that each
// begins with.
// progress: told the share done in [0, 1] after each speed; may throw to stop.
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
