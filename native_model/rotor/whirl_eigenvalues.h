// Eigenvalues of a WhirlSystem with the sense of each whirl: the numerical part of campbell.h.
#pragma once

#include <complex>
#include <vector>

#include "native_model/rotor/whirl_system.h"

namespace rotorub {

// s of the mode x + i y ~ e^{s t} (forward: Im s > 0, backward: Im s < 0), and q' of it: isotropic
// planes: n, of x + i y; else 2 n, those of x before those of y, of the value of the complex pair
// with Im s > 0.
struct Whirl {
  std::complex<double> s;
  Eigen::VectorXcd rates;
};

// Two for each mode kept, those of least |s|; isotropic planes: as many forward as backward.
// Ordered by |Im s|, backward before forward where they are equal. Throws std::runtime_error where
// the iteration does not converge.
std::vector<Whirl> whirls(const WhirlSystem& system, double speed);
std::vector<std::complex<double>> whirl_eigenvalues(const WhirlSystem& system, double speed);

}  // namespace rotorub
