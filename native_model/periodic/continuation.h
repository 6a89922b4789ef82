// A branch of periodic motions over one parameter p of a scene, by continuation in the arclength of
// (x, ln T, p) (H. B. Keller, 1977): a step along the tangent, then Newton's method on
//
//   P(x, T, p) - x = 0,  (phase condition, if autonomous),  tangent . (X - X_predicted) = 0,
//
// so that the branch is followed around its folds and where it is unstable. Between two points of
// the branch the multipliers show what has happened (Y. A. Kuznetsov, Elements of Applied
// Bifurcation Theory, 2004):
//
//   fold             dp/ds changes its sign; a multiplier passes +1
//   branching        a real multiplier passes +1 without a fold
//   period doubling  a real multiplier passes -1
//   torus            a complex pair crosses the unit circle (Neimark and Sacker)
//   grazing          the sequence of events changes: an impact more or less, sticking or not
//
// The first four are located by the secant method along the branch, grazing by bisection. Where the
// branch cannot be followed further, a period begins at another instant, far from all events; if
// this does not help and the events change beyond the last point, this point grazes. A branch also
// ends at a period doubling of motions of half the period, where it would return on itself.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "native_model/periodic/periodic_motion.h"

namespace rotorub::periodic {

enum class PointKind { kRegular, kFold, kBranching, kPeriodDoubling, kTorus, kGrazing };
const char* to_string(PointKind kind);

struct BranchPoint {
  PointKind kind = PointKind::kRegular;
  double parameter = 0.0;
  PeriodicMotion motion;
};

struct ContinuationParameters {
  double lowest = 0.0, highest = 0.0;  // range of p
  double scale = 1.0;                  // > 0, typical change of p, its unit in the arclength
  double direction = 1.0;              // +1 or -1: first towards larger or smaller p
  // Steps in arclength, of which one is the size of the state or `scale`.
  double first_step = 0.02, least_step = 1e-6, longest_step = 0.1;
  int most_points = 200;
  SearchParameters search{};
};

struct Branch {
  std::vector<BranchPoint> points;  // in the order of the branch, special points among them
  std::string end;                  // why it ends there
};
// The reason if a branch ends where its motions have half the period.
inline constexpr const char* kAtDoubling = "a period doubling of motions of half the period";

// model_at: the model for a value of p; all must have the same coordinates. start: a periodic
// motion at `parameter`, found there.
Branch continue_branch(const std::function<Model(double)>& model_at, double parameter,
                       const PeriodicMotion& start, const ContinuationParameters& parameters);

// The branch of twice the period that begins at a period doubling of another branch, whatever its
// side of it and its stability (period_doubling.h). Its first point is the period doubling, seen
// over two periods. Without points if none is found; `end` gives the reason. The direction of the
// parameters does not matter.
Branch continue_doubled(const std::function<Model(double)>& model_at, const BranchPoint& doubling,
                        const ContinuationParameters& parameters);

}  // namespace rotorub::periodic
