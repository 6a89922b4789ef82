#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "native_model/contact/impact.h"
#include "native_model/contact/kinematics.h"
#include "native_model/contact/planar_contact.h"
#include "tests/support/contact_residual.h"

namespace rotorub {
namespace {

constexpr double kRoundOff = 1e-12;  // scaled residual of a 2x2 solve in double

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

// ---------------------------------------------------------------- kinematics
// The intersection of straight paths with the circle, and the normal of a contact that they close.

constexpr double kRing = 0.5e-3;  // m

TEST(CircleExit, FromInsideIsWhereThePathCrosses) {
  EXPECT_DOUBLE_EQ(circle_exit({0.0, 0.0}, {2.0 * kRing, 0.0}, kRing).value(), 0.5);
  EXPECT_DOUBLE_EQ(circle_exit({0.5 * kRing, 0.0}, {-3.0 * kRing, 0.0}, kRing).value(), 0.5);
  EXPECT_FALSE(circle_exit({0.0, 0.0}, {0.5 * kRing, 0.0}, kRing));
}

TEST(CircleExit, FromOutsideIsAtOnceOrWhereItComesOutAgain) {
  EXPECT_EQ(circle_exit({1.01 * kRing, 0.0}, {1e-4, 0.0}, kRing).value(), 0.0);
  // Through the middle: in at 0.01, out at 2.01 radii of 4.
  EXPECT_NEAR(circle_exit({1.01 * kRing, 0.0}, {-4.0 * kRing, 0.0}, kRing).value(), 2.01 / 4.0,
              1e-12);
  // A chord from the circle itself: 2 cos 45 deg of its radius.
  const double chord = std::sqrt(2.0) * kRing;
  EXPECT_NEAR(circle_exit({kRing, 0.0}, {-2.0 * kRing, 2.0 * kRing}, kRing).value(),
              chord / (std::sqrt(8.0) * kRing), 1e-12);
  EXPECT_FALSE(circle_exit({1.5 * kRing, 0.0}, {-1e-6, 1e-3}, kRing)) << "passes by";
}

TEST(ReachCircle, IsTheFirstPointFromOutside) {
  EXPECT_DOUBLE_EQ(reach_circle({2.0 * kRing, 0.0}, {-kRing, 0.0}, kRing).value(), 1.0);
  EXPECT_FALSE(reach_circle({2.0 * kRing, 0.0}, {kRing, 0.0}, kRing)) << "leads away";
  EXPECT_FALSE(reach_circle({2.0 * kRing, 0.0}, {-kRing, 2.0 * kRing}, kRing)) << "passes by";
}

TEST(NormalOfPath, IsThatOfItsBeginUnlessItLeavesElsewhere) {
  const Eigen::Vector2d d{0.3e-3, 0.4e-3}, outward = d.normalized();
  EXPECT_LT((normal_of_path(d, 2.0 * d, kRing) - outward).norm(), 1e-15);
  // Through the middle and out on the other side.
  EXPECT_LT((normal_of_path(0.5 * d, -3.0 * d, kRing) + outward).norm(), 1e-15);
  // From the centre this is the only direction.
  EXPECT_LT((normal_of_path({0.0, 0.0}, 3.0 * d, kRing) - outward).norm(), 1e-15);
  // Outside already.
  EXPECT_LT((normal_of_path(1.5 * d, -0.1 * d, kRing) - outward).norm(), 1e-15);
}

// ------------------------------------------------------------------

// The rates of a contact, and the work of an impulse on them.

constexpr double kLastDigit = 1e-15;

TEST(ContactKinematics, RatesAreThoseOfTheContactPoint) {
  const Eigen::Vector2d d{3e-4, -4e-4}, dv{0.2, 0.7};
  const ContactPoint p = contact_kinematics(d, dv, 30.0, 0.05, 6e-4);
  const Eigen::Vector2d rates = rates_along(p.e_r, 0.05, {dv.x(), dv.y(), 30.0});
  EXPECT_NEAR(rates.x(), p.gap_rate, kLastDigit);
  EXPECT_NEAR(rates.y(), p.slip, kLastDigit);
}

// A wall throws a disc of 2 kg back: e_r = (1, 0), the impulse along -x and y.
TEST(ContactKinematics, AnImpulsesWorkIsItsEnergy) {
  const Eigen::Vector2d e_r{1.0, 0.0}, before{0.4, 0.3};
  const double mass = 2.0, normal = 1.2, friction = -0.25;
  const Eigen::Vector2d after = before + Eigen::Vector2d(-normal, friction) / mass;
  const auto rates = [&](const Eigen::Vector2d& v) {
    return rates_along(e_r, 0.0, {v.x(), v.y(), 0.0});
  };
  const ImpulseWork work = impulse_work(normal, friction, rates(before), rates(after));
  EXPECT_NEAR(work.total(), 0.5 * mass * (after.squaredNorm() - before.squaredNorm()), kLastDigit);
  EXPECT_NEAR(work.friction, 0.5 * mass * (after.y() * after.y() - before.y() * before.y()),
              kLastDigit);
  EXPECT_LT(work.friction, 0.0) << "friction brakes";
}

}  // namespace
}  // namespace rotorub
