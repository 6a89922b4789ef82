#include "native_model/numerics/linear_solve.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

namespace rotorub {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

MatrixXd lu_solve(const MatrixXd& A, const MatrixXd& b) { return A.partialPivLu().solve(b); }
VectorXd lu_solve(const MatrixXd& A, const VectorXd& b) { return A.partialPivLu().solve(b); }
MatrixXcd lu_solve(const MatrixXcd& A, const MatrixXcd& b) { return A.partialPivLu().solve(b); }
VectorXcd lu_solve(const MatrixXcd& A, const VectorXcd& b) { return A.partialPivLu().solve(b); }
MatrixXd lu_inverse(const MatrixXd& A) { return A.inverse(); }
MatrixXcd lu_inverse(const MatrixXcd& A) { return A.inverse(); }
double lu_determinant(const MatrixXd& A) { return A.determinant(); }
MatrixXd full_lu_solve(const MatrixXd& A, const MatrixXd& b) { return A.fullPivLu().solve(b); }

ConditionedSolution lu_solve_conditioned(const MatrixXcd& A, const VectorXcd& b) {
  const Eigen::PartialPivLU<MatrixXcd> lu(A);
  return {lu.solve(b), lu.rcond()};
}

Cholesky::Cholesky(const MatrixXd& A) {
  const Eigen::LLT<MatrixXd> llt(A);
  factor_ = llt.matrixLLT();
  positive_ = llt.info() == Eigen::Success;
}
MatrixXd Cholesky::solve(const MatrixXd& b) const {
  MatrixXd x = solve_lower(b);
  factor_.triangularView<Eigen::Lower>().transpose().solveInPlace(x);
  return x;
}
VectorXd Cholesky::solve(const VectorXd& b) const {
  VectorXd x = solve_lower(b);
  factor_.triangularView<Eigen::Lower>().transpose().solveInPlace(x);
  return x;
}
MatrixXd Cholesky::solve_lower(const MatrixXd& b) const {
  return factor_.triangularView<Eigen::Lower>().solve(b);
}
VectorXd Cholesky::solve_lower(const VectorXd& b) const {
  return factor_.triangularView<Eigen::Lower>().solve(b);
}
MatrixXd Cholesky::lower_inverse() const {
  return solve_lower(MatrixXd::Identity(factor_.rows(), factor_.cols()).eval());
}

LdltFactors ldlt_factors(const MatrixXd& A) {
  const Eigen::LDLT<MatrixXd> factors(A);
  const MatrixXd lower = factors.matrixL();
  return {factors.transpositionsP().transpose() * lower, factors.vectorD()};
}
VectorXd ldlt_solve(const MatrixXd& A, const VectorXd& b) { return A.ldlt().solve(b); }
ConditionedInverse ldlt_inverse(const MatrixXd& A) {
  const Eigen::LDLT<MatrixXd> factors(A);
  return {factors.solve(MatrixXd::Identity(A.rows(), A.cols())), factors.rcond()};
}

VectorXd least_squares(const MatrixXd& A, const VectorXd& b) {
  return A.completeOrthogonalDecomposition().solve(b);
}

MatrixXd orthogonal_complement(const MatrixXd& directions) {
  const Eigen::Index n = directions.rows();
  const Eigen::HouseholderQR<MatrixXd> qr(directions);
  return qr.householderQ() * MatrixXd::Identity(n, n).rightCols(n - directions.cols());
}

}  // namespace rotorub
