// The eigenvalues of least size of a large quadratic problem (s^2 + s B + C) q = 0: those that lie
// nearest to 0, by an Arnoldi iteration of (A - sigma)^-1, A the first-order form of the problem
// with the state (W q, q') (Y. Saad, "Numerical Methods for Large Eigenvalue Problems", 2011). It
// costs one factorisation and a small eigenproblem where all of A would cost a large one, and low
// eigenvalues lose no digits to stiff coordinates.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <functional>
#include <optional>

namespace rotorub {

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
