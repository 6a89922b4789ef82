// Dense linear systems A x = b. Eigen's factorisations compile slowly, so they are compiled only in
// linear_solve.cc and used through these functions. A is n x n and b has n rows; other sizes fail
// an assertion.
#pragma once

#include <Eigen/Core>

namespace rotorub {

// Gaussian elimination with partial pivoting. The result is not finite if A is singular.
Eigen::MatrixXd lu_solve(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b);
Eigen::VectorXd lu_solve(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
Eigen::MatrixXcd lu_solve(const Eigen::MatrixXcd& A, const Eigen::MatrixXcd& b);
Eigen::VectorXcd lu_solve(const Eigen::MatrixXcd& A, const Eigen::VectorXcd& b);
Eigen::MatrixXd lu_inverse(const Eigen::MatrixXd& A);
Eigen::MatrixXcd lu_inverse(const Eigen::MatrixXcd& A);
double lu_determinant(const Eigen::MatrixXd& A);
// Full pivoting, for a matrix that may be close to singular.
Eigen::MatrixXd full_lu_solve(const Eigen::MatrixXd& A, const Eigen::MatrixXd& b);

// The solution x and an estimate of 1 / (|A| |A^-1|) in the 1-norm, which is 0 if A is singular.
struct ConditionedSolution {
  Eigen::VectorXcd x;
  double reciprocal_condition;
};
ConditionedSolution lu_solve_conditioned(const Eigen::MatrixXcd& A, const Eigen::VectorXcd& b);

// A = L L^T for a symmetric matrix. Only the lower triangle is read.
class Cholesky {
 public:
  explicit Cholesky(const Eigen::MatrixXd& A);
  // True if A is positive definite. The functions below require it.
  bool positive() const { return positive_; }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;        // A^-1 b
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;        // A^-1 b
  Eigen::MatrixXd solve_lower(const Eigen::MatrixXd& b) const;  // L^-1 b
  Eigen::VectorXd solve_lower(const Eigen::VectorXd& b) const;  // L^-1 b
  Eigen::MatrixXd lower_inverse() const;                        // L^-1

 private:
  Eigen::MatrixXd factor_;  // L in the lower triangle
  bool positive_;
};

// A = P^T L diag(d) L^T P for a symmetric matrix that may be semi-definite.
struct LdltFactors {
  Eigen::MatrixXd lower;  // P^T L
  Eigen::VectorXd d;
};
LdltFactors ldlt_factors(const Eigen::MatrixXd& A);
Eigen::VectorXd ldlt_solve(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
// A^-1 and an estimate of the reciprocal condition of A in the 1-norm.
struct ConditionedInverse {
  Eigen::MatrixXd inverse;
  double reciprocal_condition;
};
ConditionedInverse ldlt_inverse(const Eigen::MatrixXd& A);

// The least-squares solution of least norm. A: m x n of any rank, b: m.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

// Orthonormal columns that span the orthogonal complement of the columns of `directions`, which is
// n x m of full rank, m < n. Result: n x (n - m).
Eigen::MatrixXd orthogonal_complement(const Eigen::MatrixXd& directions);

}  // namespace rotorub
