// Critical speeds of a rotor on springs that follow the speed, by counting. In coordinates of unit
// mass, A = 1 - G or of both planes (critical_speeds.cc), F diagonal, of the r springs:
//
//   D(s) v = 0,   D(s) = K(s) - s^2 A,   K(s) = K + U F(s) U^T.
//
// As many critical speeds of the springs at s lie below s as D(s) has negative eigenvalues. With
// A V = K(a) V mu at one speed a, V^T K(a) V = 1 and W = V^T U, that number is (E. V. Haynsworth,
// "Determination of the inertia of a partitioned Hermitian matrix", Linear Algebra Appl. 1, 1968)
//
//   n(D) = n(d) + n(S) - n(-1/f),   d = 1 - s^2 mu,   f = F(s) - F(a),   S = -1/f - W^T (1/d) W,
//
// of small matrices: one decomposition for all speeds, where the search by eigenvalues at each
// speed took 13 s of a mesh of 164 modes.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

namespace rotorub {

class SpringCrossings {
 public:
  using Springs = std::function<Eigen::VectorXd(double speed)>;  // r, F(s)

  // stiffness: K(reference), N x N; inertia: A; shapes: U, N x r. None where K is not symmetric and
  // positive definite: the count is of critical speeds only there.
  static std::optional<SpringCrossings> of(const Eigen::MatrixXd& stiffness,
                                           const Eigen::MatrixXd& inertia,
                                           const Eigen::MatrixXd& shapes, Springs springs,
                                           double reference);

  // Critical speeds of the springs at `speed` that lie below it.
  Eigen::Index below(double speed) const;

  // Whether every curve of critical speeds over the springs' speed is crossed once at most between
  // two points of the tables, a < b, so that the counts at the ends tell of all: v^T D v falls
  // through 0 once for each v where v^T K v / s^2 falls, 2 K > s K'.
  bool once_between(double a, double b) const;

  // The crossings of the `most` lowest curves in [a, b), to `accuracy` (absolute), ascending.
  std::vector<double> between(double a, double b, Eigen::Index most, double accuracy) const;

 private:
  Eigen::Index negatives(const Eigen::ArrayXd& d, const Eigen::VectorXd& f) const;

  Eigen::ArrayXd mu_;   // N, 1/s^2
  Eigen::MatrixXd W_;   // N x r
  Eigen::VectorXd at_;  // r, F(a)
  Springs springs_;
};

}  // namespace rotorub
