// The lowest eigenvalues of a quadratic problem against all of them, and against a closed form.
#include "native_model/numerics/eigenvalues.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <vector>

namespace rotorub {
namespace {

using Complex = std::complex<double>;

Enough at_least(Eigen::Index count) {
  return [count](const Eigen::VectorXcd& values) { return values.size() >= count; };
}

// s^2 + 2 zeta w s + w^2 of each coordinate by itself, stiff ones of 1e8 rad/s among them: two of
// each value, as of two planes that are alike.
TEST(LowestModes, OfCoordinatesByThemselvesTwiceEach) {
  constexpr Eigen::Index kHalf = 60;
  constexpr double kZeta = 0.01;
  Eigen::VectorXd w(2 * kHalf);
  for (Eigen::Index k = 0; k < kHalf; ++k)
    w[k] = w[kHalf + k] = 100.0 * std::pow(1.26, static_cast<double>(k));
  const Eigen::MatrixXd B = (2.0 * kZeta * w).asDiagonal(), C = w.cwiseAbs2().asDiagonal();
  const auto found = lowest_modes(B, C, w, 5.0, 24, at_least(24));
  ASSERT_TRUE(found);
  ASSERT_GE(found->values.size(), 24);
  for (Eigen::Index j = 0; j < 24; ++j) {
    const Complex exact = w[j / 4] * Complex(-kZeta, std::sqrt(1.0 - kZeta * kZeta));
    const Complex s = found->values[j];
    EXPECT_LT(std::abs(Complex(s.real(), std::abs(s.imag())) - exact), 1e-10 * std::abs(exact))
        << j;
    // Nothing else moves.
    const Eigen::VectorXcd v = found->rates.col(j);
    EXPECT_NEAR(std::norm(v[j / 4]) + std::norm(v[kHalf + j / 4]), v.squaredNorm(),
                1e-12 * v.squaredNorm())
        << j;
  }
}

TEST(LowestModes, AreTheLowestOfAllOfThem) {
  constexpr Eigen::Index kSize = 80;
  std::srand(5);
  Eigen::VectorXd w(kSize);
  for (Eigen::Index k = 0; k < kSize; ++k) w[k] = 50.0 * std::pow(1.22, static_cast<double>(k));
  const Eigen::MatrixXd random = Eigen::MatrixXd::Random(kSize, kSize);
  const Eigen::MatrixXd B = 3.0 * (random - random.transpose());
  Eigen::MatrixXd C = w.cwiseAbs2().asDiagonal();
  C += 0.002 * w.asDiagonal() * Eigen::MatrixXd::Random(kSize, kSize) * w.asDiagonal();
  const auto found = lowest_modes(B, C, w, 2.0, 12, at_least(12));
  ASSERT_TRUE(found);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * kSize, 2 * kSize);
  A.topRightCorner(kSize, kSize).diagonal() = w;
  A.bottomLeftCorner(kSize, kSize) = -C * w.cwiseInverse().asDiagonal();
  A.bottomRightCorner(kSize, kSize) = -B;
  std::vector<Complex> all = real_eigenvalues(A).value();
  std::sort(all.begin(), all.end(), [](Complex a, Complex b) { return std::abs(a) < std::abs(b); });
  for (Eigen::Index j = 0; j < 12; ++j) {
    EXPECT_NEAR(std::abs(found->values[j]) / std::abs(all[static_cast<std::size_t>(j)]), 1.0, 1e-6)
        << j;
  }
}

TEST(LowestModes, LeavesToOthersWhatIsTooSmall) {
  const Eigen::VectorXd w = Eigen::VectorXd::LinSpaced(6, 1.0, 6.0);
  const Eigen::MatrixXd C = w.cwiseAbs2().asDiagonal();
  EXPECT_FALSE(lowest_modes(Eigen::MatrixXd::Zero(6, 6).eval(), C, w, 0.05, 8, at_least(8)));
}

}  // namespace
}  // namespace rotorub
