// Eigenvalues of small dense matrices. Eigen's solvers take long to compile: they are compiled here
// alone. Nothing is given where a matrix is not finite, or the iteration does not converge or gives
// what is not finite.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <functional>
#include <optional>
#include <vector>

namespace rotorub {

// A: n x n, any; n = 0 gives an empty list. By falling real part, then by rising imaginary part.
std::optional<std::vector<std::complex<double>>> real_eigenvalues(const Eigen::MatrixXd& A);
std::optional<std::vector<std::complex<double>>> complex_eigenvalues(const Eigen::MatrixXcd& A);

// A v_j = s_j v_j, |v_j| = 1.
struct EigenModes {
  Eigen::VectorXcd values;   // n, in no order; of a real matrix the one with Im > 0 first of a pair
  Eigen::MatrixXcd vectors;  // n x n, a column each
};
// A: n x n, n > 0.
std::optional<EigenModes> real_modes(const Eigen::MatrixXd& A);
std::optional<EigenModes> complex_modes(const Eigen::MatrixXcd& A);

// Of symmetric matrices, n x n, n > 0; the lower triangle is read.
struct SymmetricModes {
  Eigen::VectorXd values;   // n, ascending
  Eigen::MatrixXd vectors;  // n x n, a column each: V^T V = 1, with a second matrix V^T B V = 1
};
// A v = s v.
std::optional<SymmetricModes> symmetric_modes(const Eigen::MatrixXd& A);
std::optional<Eigen::VectorXd> symmetric_eigenvalues(const Eigen::MatrixXd& A);
// A v = s B v, B positive definite (the caller's word).
std::optional<SymmetricModes> symmetric_modes(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);
std::optional<Eigen::VectorXd> symmetric_eigenvalues(const Eigen::MatrixXd& A,
                                                     const Eigen::MatrixXd& B);

// n times the root of the largest entry of C, n x n: about the highest frequency; 1 where C is 0.
template <class Matrix>
Eigen::VectorXd frequency_scale(const Matrix& C) {
  const double largest = C.size() > 0 ? C.cwiseAbs().maxCoeff() : 0.0;
  return Eigen::VectorXd::Constant(C.rows(), largest > 0.0 ? std::sqrt(largest) : 1.0);
}

// The first-order form of (s^2 + s B + C) q = 0 with the state (W q, q'): W about the frequencies
// makes all entries of the size of one. B, C: n x n; W: n, not 0. The state ends with q'.
template <class Matrix>
Matrix first_order_form(const Matrix& B, const Matrix& C, const Eigen::VectorXd& W) {
  const Eigen::Index n = W.size();
  Matrix A = Matrix::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).diagonal() = W.template cast<typename Matrix::Scalar>();
  for (Eigen::Index j = 0; j < n; ++j) A.col(j).tail(n) = -C.col(j) / W[j];
  A.bottomRightCorner(n, n) = -B;
  return A;
}

// The eigenvalues of least size of a large quadratic problem (s^2 + s B + C) q = 0: those that lie
// nearest to 0, by an Arnoldi iteration of (A - sigma)^-1, A the first-order form of the problem
// with the state (W q, q') (Y. Saad, "Numerical Methods for Large Eigenvalue Problems", 2011). It
// costs one factorisation and a small eigenproblem where all of A would cost a large one, and low
// eigenvalues lose no digits to stiff coordinates.
struct LowestModes {
  Eigen::VectorXcd values;  // s, ascending in size: all that there are up to the last
  Eigen::MatrixXcd rates;   // N x as many, q' of each
};

// B, C: N x N; W: N, > 0, about the size of the frequencies; shift: sigma > 0, rad/s, small against
// the eigenvalues wanted; guess: how many are wanted. `enough` is asked with those found so far,
// which grow from call to call. Each is right to 1e-11 of (A - sigma)^-1. Nothing where that takes
// more than half of all directions: then the whole of A is the way.
using Enough = std::function<bool(const Eigen::VectorXcd& values)>;
std::optional<LowestModes> lowest_modes(const Eigen::MatrixXd& B, const Eigen::MatrixXd& C,
                                        const Eigen::VectorXd& W, double shift, Eigen::Index guess,
                                        const Enough& enough);
std::optional<LowestModes> lowest_modes(const Eigen::MatrixXcd& B, const Eigen::MatrixXcd& C,
                                        const Eigen::VectorXd& W, double shift, Eigen::Index guess,
                                        const Enough& enough);

}  // namespace rotorub
