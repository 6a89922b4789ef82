#include "native_model/rotor/legendre.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rotorub {
namespace {

constexpr double kRoundOff = 1e-14;  // a few units in the last place of values up to 2

TEST(GaussLegendre, IsExactUpToDegreeTwoNMinusOne) {
  for (int n = 1; n <= 20; ++n) {
    const GaussRule rule = gauss_legendre(n);
    for (int power = 0; power < 2 * n; ++power) {
      const double sum = (rule.weight.array() * rule.node.array().pow(power)).sum();
      EXPECT_NEAR(sum, power % 2 == 0 ? 2.0 / (power + 1) : 0.0, kRoundOff) << n << " " << power;
    }
  }
}

TEST(GaussLegendre, MissesDegreeTwoN) {
  const GaussRule rule = gauss_legendre(3);
  EXPECT_GT(std::abs((rule.weight.array() * rule.node.array().pow(6)).sum() - 2.0 / 7.0), 1e-3);
}

TEST(IntegratedLegendre, KnownPolynomials) {
  const double xi = 0.3;
  const LegendreValues v = integrated_legendre(3, xi);
  EXPECT_NEAR(v.value[2], 0.5 * (3.0 * xi * xi - 1.0), kRoundOff);
  EXPECT_NEAR(v.first[1], 0.5 * (xi * xi - 1.0), kRoundOff);
  EXPECT_NEAR(v.second[1], (xi * xi * xi + 1.0) / 6.0 - 0.5 * (xi + 1.0), kRoundOff);
}

// Each row of integrals against quadrature of the row before.
TEST(IntegratedLegendre, IntegralsAgreeWithQuadrature) {
  constexpr int kCount = 14;
  const GaussRule rule = gauss_legendre(kCount);
  for (double xi : {-1.0, -0.7, 0.0, 0.4, 1.0}) {
    const LegendreValues v = integrated_legendre(kCount, xi);
    Eigen::VectorXd first = Eigen::VectorXd::Zero(kCount), second = first;
    for (int i = 0; i < rule.node.size(); ++i) {
      const double at = -1.0 + 0.5 * (xi + 1.0) * (rule.node[i] + 1.0);
      const LegendreValues inner = integrated_legendre(kCount, at);
      first += 0.5 * (xi + 1.0) * rule.weight[i] * inner.value;
      second += 0.5 * (xi + 1.0) * rule.weight[i] * inner.first;
    }
    EXPECT_LT((v.first - first).cwiseAbs().maxCoeff(), kRoundOff);
    EXPECT_LT((v.second - second).cwiseAbs().maxCoeff(), kRoundOff);
  }
}

TEST(IntegratedLegendre, HigherOnesAreBubbles) {
  const LegendreValues v = integrated_legendre(12, 1.0);
  EXPECT_LT(v.first.tail(11).cwiseAbs().maxCoeff(), kRoundOff);
  EXPECT_LT(v.second.tail(10).cwiseAbs().maxCoeff(), kRoundOff);
}

}  // namespace
}  // namespace rotorub
