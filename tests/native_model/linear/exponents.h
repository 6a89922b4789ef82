// The exponents of a measured decay or growth.
#pragma once

#include <Eigen/Core>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <vector>

#include "native_model/linear/rub_system.h"
#include "native_model/numerics/eigenvalues.h"

namespace rotorub::test {

// Exponents s_j of x_k = sum c_j e^{s_j k step}, of `count` terms, by the matrix pencil: nothing is
// known of them beforehand. By falling real part.
inline std::vector<rub::Complex> exponents(const std::vector<double>& x, double step,
                                           Eigen::Index count) {
  const auto all = static_cast<Eigen::Index>(x.size()), wide = all / 2;
  Eigen::MatrixXd now(all - wide, wide), next(all - wide, wide);
  for (Eigen::Index i = 0; i < all - wide; ++i) {
    for (Eigen::Index j = 0; j < wide; ++j) {
      now(i, j) = x[static_cast<std::size_t>(i + j)];
      next(i, j) = i + j + 1 < all ? x[static_cast<std::size_t>(i + j + 1)] : 0.0;
    }
  }
  now.conservativeResize(all - wide - 1, wide);
  next.conservativeResize(all - wide - 1, wide);
  // Jacobi's: the matrices are small, and the other takes a minute to compile.
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(now, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::MatrixXd pencil = svd.singularValues().head(count).cwiseInverse().asDiagonal() *
                                 svd.matrixU().leftCols(count).transpose() * next *
                                 svd.matrixV().leftCols(count);
  std::vector<rub::Complex> found = real_eigenvalues(pencil).value();
  for (rub::Complex& z : found) z = std::log(z) / step;
  std::sort(found.begin(), found.end(),
            [](const rub::Complex& a, const rub::Complex& b) { return a.real() > b.real(); });
  return found;
}

}  // namespace rotorub::test
