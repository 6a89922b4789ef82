// Critical speeds of a rotor on springs that depend on the speed, found by counting. In coordinates
// of unit mass, with A = 1 - G or its form for both planes (critical_speeds.cc) and F diagonal, the
// stiffnesses of the r springs,
//
//   D(s) v = 0,   D(s) = K(s) - s^2 A,   K(s) = K_0 + U F(s) U^T.
//
// With the springs frozen at s, the number of critical speeds below s is the number of negative
// eigenvalues of D(s). With A V = K(a) V mu at one speed a, V^T K(a) V = 1 and W = V^T U, that
// number is (E. V. Haynsworth, "Determination of the inertia of a partitioned Hermitian matrix",
// Linear Algebra Appl. 1, 1968)
//
//   n(D) = n(d) + n(S) - n(-1/f),   d = 1 - s^2 mu,   f = F(s) - F(a),   S = -1/f - W^T (1/d) W.
//
// These matrices are small, and one decomposition serves all speeds; a search by eigenvalues at
// each speed took 13 s for a mesh of 164 modes.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

namespace rotorub {

class SpringCrossings {
 public:
  using Springs = std::function<Eigen::VectorXd(double speed)>;  // r, F(s)

  // stiffness: K(reference), N x N; inertia: A; shapes: U, N x r. Empty if K is not symmetric and
  // positive definite, since only then does the count give critical speeds.
  static std::optional<SpringCrossings> of(const Eigen::MatrixXd& stiffness,
                                           const Eigen::MatrixXd& inertia,
                                           const Eigen::MatrixXd& shapes, Springs springs,
                                           double reference);

  // Number of critical speeds below `speed` with the springs frozen at `speed`.
  Eigen::Index below(double speed) const;

  // The same below `speed` with the springs frozen at the speed `at`; empty if K(at) is not
  // positive definite, since then the count does not give critical speeds.
  std::optional<Eigen::Index> frozen_below(double at, double speed) const;

  // Whether each curve of a critical speed over the springs' speed is crossed at most once between
  // a and b, two neighbouring points of the tables, so that the counts at the ends are sufficient:
  // v^T D v falls through 0 only once for each v if v^T K v / s^2 falls, that is, if 2 K - s K' is
  // positive definite.
  bool once_between(double a, double b) const;

  // Crossings of the `most` lowest curves in [a, b), to the absolute `accuracy`, ascending.
  std::vector<double> between(double a, double b, Eigen::Index most, double accuracy) const;

 private:
  Eigen::Index negatives(const Eigen::ArrayXd& d, const Eigen::VectorXd& f) const;

  Eigen::ArrayXd mu_;   // N, 1/s^2
  Eigen::MatrixXd W_;   // N x r
  Eigen::VectorXd at_;  // r, F(a)
  Springs springs_;
};

}  // namespace rotorub
