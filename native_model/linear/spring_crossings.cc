#include "native_model/linear/spring_crossings.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "native_model/numerics/eigenvalues.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/rotor/refusal.h"

namespace rotorub {

std::optional<SpringCrossings> SpringCrossings::of(const Eigen::MatrixXd& stiffness,
                                                   const Eigen::MatrixXd& inertia,
                                                   const Eigen::MatrixXd& shapes, Springs springs,
                                                   double reference) {
  if (stiffness != stiffness.transpose() || !Cholesky(stiffness).positive()) return {};
  const SymmetricModes modes = found_by(symmetric_modes(inertia, stiffness));
  SpringCrossings crossings;
  crossings.mu_ = modes.values.array();
  crossings.W_ = modes.vectors.transpose() * shapes;
  crossings.at_ = springs(reference);
  crossings.springs_ = std::move(springs);
  return crossings;
}

// Negative eigenvalues of diag(d) + W diag(f) W^T. S is scaled by the square roots of |f|, so that
// a spring that hardly changed does not lose the others in round-off.
Eigen::Index SpringCrossings::negatives(const Eigen::ArrayXd& d, const Eigen::VectorXd& f) const {
  // At a critical speed of the reference itself D is singular; a small offset avoids this.
  constexpr double kOffset = std::numeric_limits<double>::epsilon();
  const Eigen::ArrayXd regular = (d.abs() < kOffset).select(kOffset, d);
  Eigen::Index count = (regular < 0.0).count();
  std::vector<Eigen::Index> changed;
  for (Eigen::Index i = 0; i < f.size(); ++i) {
    if (f[i] != 0.0) changed.push_back(i);
  }
  if (changed.empty()) return count;
  const Eigen::VectorXd part = f(changed), root = part.cwiseAbs().cwiseSqrt();
  const Eigen::MatrixXd w = W_(Eigen::all, changed) * root.asDiagonal();
  Eigen::MatrixXd S = -(w.transpose() * regular.inverse().matrix().asDiagonal() * w);
  S.diagonal() -= part.cwiseSign();
  count += (found_by(symmetric_eigenvalues(S)).array() < 0.0).count();
  return count - (part.array() > 0.0).count();
}

Eigen::Index SpringCrossings::below(double speed) const {
  return negatives(1.0 - speed * speed * mu_, springs_(speed) - at_);
}

std::optional<Eigen::Index> SpringCrossings::frozen_below(double at, double speed) const {
  const Eigen::VectorXd f = springs_(at) - at_;
  if (negatives(Eigen::ArrayXd::Ones(mu_.size()), f) > 0) return std::nullopt;
  return negatives(1.0 - speed * speed * mu_, f);
}

bool SpringCrossings::once_between(double a, double b) const {
  // F - s F' / 2 is a cubic in the interval. Between so many samples it exceeds them by less than a
  // twentieth of their range (Markov's bound on its second derivative).
  constexpr int kSamples = 16;
  constexpr double kBeyond = 0.05, kSlope = 1e-4;
  const double h = kSlope * (b - a);
  Eigen::VectorXd low, high, softest;
  for (int k = 0; k <= kSamples; ++k) {
    const double s = std::clamp(a + (b - a) * k / kSamples, a + h, b - h);
    const Eigen::VectorXd F = springs_(s),
                          q = F - (springs_(s + h) - springs_(s - h)) * (s / (4.0 * h));
    low = k > 0 ? low.cwiseMin(q).eval() : q;
    high = k > 0 ? high.cwiseMax(q).eval() : q;
    softest = k > 0 ? softest.cwiseMin(F).eval() : F;
  }
  // K itself must be positive definite as well, as the count requires.
  const Eigen::VectorXd least = (low - kBeyond * (high - low)).cwiseMin(softest);
  return negatives(Eigen::ArrayXd::Ones(mu_.size()), least - at_) == 0;
}

std::vector<double> SpringCrossings::between(double a, double b, Eigen::Index most,
                                             double accuracy) const {
  std::vector<double> all;
  const Eigen::Index last = std::min(below(b), most);
  for (Eigen::Index k = below(a); k < last; ++k) {
    double low = all.empty() ? a : all.back(), high = b;
    while (high - low > accuracy) {
      const double middle = 0.5 * (low + high);
      if (middle <= low || middle >= high) break;
      (below(middle) > k ? high : low) = middle;
    }
    all.push_back(0.5 * (low + high));
  }
  return all;
}

}  // namespace rotorub
