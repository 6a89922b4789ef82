// Eigenvalues of small dense matrices. Eigen's solvers compile slowly, so they are compiled only in
// eigenvalues.cc. They return nothing if a matrix is not finite or the iteration fails.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <functional>
#include <optional>
#include <vector>

namespace rotorub {

// Sorts by descending real part, then by ascending imaginary part.
void sort_by_growth(std::vector<std::complex<double>>& values);

// The largest |s|; 0 without values.
double largest_size(const std::vector<std::complex<double>>& values);
// The smallest |s| > 0; infinite if there is none.
double smallest_size(const std::vector<std::complex<double>>& values);

// A: any n x n matrix; n = 0 gives an empty list. The result is in the order of sort_by_growth.
std::optional<std::vector<std::complex<double>>> real_eigenvalues(const Eigen::MatrixXd& A);
std::optional<std::vector<std::complex<double>>> complex_eigenvalues(const Eigen::MatrixXcd& A);

// A v_j = s_j v_j, |v_j| = 1.
struct EigenModes {
  Eigen::VectorXcd values;  // n, unsorted; for a real matrix the one with Im > 0 is first of a pair
  Eigen::MatrixXcd vectors;  // n x n, one per column
};
// A: n x n, n > 0.
std::optional<EigenModes> real_modes(const Eigen::MatrixXd& A);
std::optional<EigenModes> complex_modes(const Eigen::MatrixXcd& A);

// Modes of symmetric matrices, n x n, n > 0. Only the lower triangle is read.
struct SymmetricModes {
  Eigen::VectorXd values;   // n, ascending
  Eigen::MatrixXd vectors;  // n x n, one per column: V^T V = 1, with a second matrix V^T B V = 1
};
// A v = s v.
std::optional<SymmetricModes> symmetric_modes(const Eigen::MatrixXd& A);
std::optional<Eigen::VectorXd> symmetric_eigenvalues(const Eigen::MatrixXd& A);
// A v = s B v. B must be positive definite, which is not checked.
std::optional<SymmetricModes> symmetric_modes(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
std::optional<Eigen::VectorXd> symmetric_eigenvalues(const Eigen::MatrixXd& A,
                                                     const Eigen::MatrixXd& B);

// The square root of the largest |C_ij| as a scale of the frequencies, n times; 1 if C is 0.
template <class Matrix>
Eigen::VectorXd frequency_scale(const Matrix& C) {
  const double largest = C.size() > 0 ? C.cwiseAbs().maxCoeff() : 0.0;
  return Eigen::VectorXd::Constant(C.rows(), largest > 0.0 ? std::sqrt(largest) : 1.0);
}

// The first-order form of (s^2 + s B + C) q = 0 with the state (W q, q'). With W close to the
// frequencies all entries are of similar size. B, C: n x n; W: n, nonzero.
template <class Matrix>
Matrix first_order_form(const Matrix& B, const Matrix& C, const Eigen::VectorXd& W) {
  const Eigen::Index n = W.size();
  Matrix A = Matrix::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).diagonal() = W.template cast<typename Matrix::Scalar>();
  for (Eigen::Index j = 0; j < n; ++j) A.col(j).tail(n) = -C.col(j) / W[j];
  A.bottomRightCorner(n, n) = -B;
  return A;
}

// The smallest eigenvalues of a large quadratic problem (s^2 + s B + C) q = 0, i.e. those nearest
// to 0, by an Arnoldi iteration of (A - sigma)^-1, where A is the first-order form with the state
// (W q, q') (Y. Saad, "Numerical Methods for Large Eigenvalue Problems", 2011). This costs one
// factorisation and a small eigenproblem instead of the large one of A, and stiff coordinates do
// not reduce the accuracy of low eigenvalues.
struct LowestModes {
  Eigen::VectorXcd values;  // s, by ascending magnitude, complete up to the last
  Eigen::MatrixXcd rates;   // N x as many, q' of each mode
};

// B, C: N x N; W: N, > 0, close to the frequencies; shift: sigma > 0, rad/s, small compared with
// the wanted eigenvalues; guess: how many are wanted. `enough` is called with the eigenvalues found
// so far, whose number grows from call to call, and ends the search. Each is accurate to 1e-11 of
// (A - sigma)^-1. Returns nothing if the search needs more than half of all directions; then solve
// the whole problem.
using Enough = std::function<bool(const Eigen::VectorXcd& values)>;
std::optional<LowestModes> lowest_modes(const Eigen::MatrixXd& B, const Eigen::MatrixXd& C,
                                        const Eigen::VectorXd& W, double shift, Eigen::Index guess,
                                        const Enough& enough);
std::optional<LowestModes> lowest_modes(const Eigen::MatrixXcd& B, const Eigen::MatrixXcd& C,
                                        const Eigen::VectorXd& W, double shift, Eigen::Index guess,
                                        const Enough& enough);

}  // namespace rotorub
