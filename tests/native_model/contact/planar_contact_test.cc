#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "native_model/contact/planar_contact.h"
#include "tests/support/contact_residual.h"

namespace rotorub {
namespace {

constexpr double kPlanarSolve = 1e-12;  // of a 2x2 solve with a condition number up to 100

TEST(PlanarContact, RandomSolutionsLeaveWhatTheyPromise) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int k = 0; k < 10000; ++k) {
    const Delassus a{1.5 + unit(random), unit(random) / 3.0, unit(random) / 3.0,
                     1.5 + unit(random)};
    const double b_n = unit(random), b_t = unit(random), mu_sign = 0.9 * unit(random);
    const PlanarImpulse s = stick(a, b_n, b_t);
    ASSERT_NEAR(gap_rate_after(a, b_n, s), 0.0, kPlanarSolve);
    ASSERT_NEAR(slip_after(a, b_t, s), 0.0, kPlanarSolve);
    const double n = slide(a, b_n, mu_sign);
    const PlanarImpulse l{n, -mu_sign * n};
    ASSERT_NEAR(gap_rate_after(a, b_n, l), 0.0, kPlanarSolve);
  }
}

constexpr double kRoundOff = 1e-12;  // scaled residual of a 2x2 solve in double

TEST(Coulomb, StickByHand) {
  // L_N = 1 from y_N = L_N - 1, L_T = -0.2 from y_T = 2 L_T + 0.4, and 0.2 <= 0.5.
  const CoulombSolution s = solve_coulomb({1.0, 0.0, 0.0, 2.0}, -1.0, 0.4, 0.5);
  EXPECT_EQ(s.contact_case, ContactCase::kStick);
  EXPECT_DOUBLE_EQ(s.normal, 1.0);
  EXPECT_DOUBLE_EQ(s.friction, -0.2);
}

TEST(Coulomb, RandomCoupledProblemsSatisfyTheLaws) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int k = 0; k < 20000; ++k) {
    const double nn = std::exp(2.0 * unit(random)), tt = std::exp(2.0 * unit(random));
    const double nt = 0.95 * unit(random) * std::sqrt(nn * tt);
    const double mu = 0.95 * nn / std::abs(nt) * std::abs(unit(random));  // one solution
    const double b_n = unit(random), b_t = unit(random);
    const CoulombSolution s = solve_coulomb({nn, nt, nt, tt}, b_n, b_t, mu);
    ASSERT_EQ(s.solutions, 1);
    const double y_n = nn * s.normal + nt * s.friction + b_n;
    const double y_t = nt * s.normal + tt * s.friction + b_t;
    const double scale = std::max(
        {std::abs(b_n), std::abs(b_t), std::abs(nn * s.normal), std::abs(tt * s.friction)});
    const ContactResidual r = contact_residual(y_n, s.normal, s.friction, y_t, mu, scale,
                                               scale / std::min(nn, tt), scale);
    ASSERT_LT(r.complementarity, kRoundOff) << k;
    ASSERT_LT(r.coulomb, kRoundOff) << k;
    ASSERT_LE(s.friction * y_t, kRoundOff * scale * scale) << "friction is dissipative";
  }
}

TEST(Coulomb, PainleveIsSaidNotHidden) {
  // mu a_nt > a_nn: sliding pushes itself in. Where the bodies part, free flight, sliding and a jam
  // are all solutions; where they close, the jam alone.
  const Delassus a{1.0, 1.9, 1.9, 4.0};
  const double mu = 1.0;
  EXPECT_EQ(solve_coulomb(a, 0.5, 5.0, mu).solutions, 3);
  const CoulombSolution jam = solve_coulomb(a, -0.5, 5.0, mu);
  EXPECT_EQ(jam.solutions, 1);
  EXPECT_EQ(jam.contact_case, ContactCase::kStick);
}

TEST(Coulomb, AnUnsymmetricMatrixMayHaveNoSolution) {
  const Delassus a{1.0, 2.0, 3.0, 1.0};
  EXPECT_EQ(solve_coulomb(a, -0.5, 5.0, 1.0).solutions, 0);
}

}  // namespace
}  // namespace rotorub
