// Branch switching at a period doubling (Y. A. Kuznetsov, Elements of Applied Bifurcation Theory,
// 2004). Where the return map P of a branch has the multiplier -1 with the eigenvector v, its
// square has the multiplier +1, and a branch of twice the period begins:
//
//   P(P(x)) - x = 0,   x = x_0 + a v + O(a^2),   p = p_0 + O(a^2),   a > 0.
//
// The motions with a < 0 are those with a > 0 one period of the first branch later. Newton's method
// begins at x_0 + a v, p_0, and stays in the plane whose normal is the part of v normal to the
// tangent of the first branch, so that it cannot return to the first branch.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "native_model/periodic/branch_corrector.h"

namespace rotorub::periodic {

// True if a multiplier of the motion is -1, up to 1e-4.
bool flips(const PeriodicMotion& motion);

// The beginning of a branch of twice the period.
struct DoubledBranch {
  BranchPoint begin;  // the period doubling itself, over two periods
  std::unique_ptr<BranchCorrector> corrector;
  CorrectedPoint first;  // next to it
};

// The branch of twice the period at a period doubling. Empty if the motion has no multiplier -1, or
// Newton's method finds no motion of twice the period beside it. Both references must outlive the
// result.
std::optional<DoubledBranch> doubled_branch(const std::function<Model(double)>& model_at,
                                            const BranchPoint& doubling,
                                            const ContinuationParameters& parameters);

// True if between these neighbouring points of a branch the motion has half the period, as at a
// period doubling where the branch ends: beyond it lie the same motions half a period later.
bool has_half_period_between(const std::function<Model(double)>& model_at,
                             const ContinuationParameters& parameters, const CorrectedPoint& from,
                             const CorrectedPoint& to);
// The point where it has half the period, as DoubledBranch::begin; empty if it is not found.
std::optional<BranchPoint> half_period_between(const std::function<Model(double)>& model_at,
                                               const ContinuationParameters& parameters,
                                               const CorrectedPoint& from,
                                               const CorrectedPoint& to);

}  // namespace rotorub::periodic
