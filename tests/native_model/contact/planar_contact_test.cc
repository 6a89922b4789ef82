#include "native_model/contact/planar_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace rotorub {
namespace {

constexpr double kPlanarSolve = 1e-12;  // of a 2x2 solve with a condition number up to 100

TEST(PlanarContact, StickByHand) {
  // [2 1; 0.5 3] (1, -2) = (0, -5.5).
  const PlanarMatrix<double> a{2.0, 1.0, 0.5, 3.0};
  const PlanarImpulse<double> l = stick(a, -0.0, 5.5);
  EXPECT_DOUBLE_EQ(l.normal, 1.0);
  EXPECT_DOUBLE_EQ(l.friction, -2.0);
}

TEST(PlanarContact, SlideByHand) {
  // mu sign = 0.5: L_N (2 - 0.5) = 3, y_T = 4 + (0.5 - 1.5) 2.
  const PlanarMatrix<double> a{2.0, 1.0, 0.5, 3.0};
  EXPECT_DOUBLE_EQ(slide(a, -3.0, 0.5), 2.0);
  EXPECT_DOUBLE_EQ(slip_after_slide(a, 4.0, 0.5, 2.0), 2.0);
}

TEST(PlanarContact, RandomSolutionsLeaveWhatTheyPromise) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int k = 0; k < 10000; ++k) {
    const PlanarMatrix<double> a{1.5 + unit(random), unit(random) / 3.0, unit(random) / 3.0,
                                 1.5 + unit(random)};
    const double b_n = unit(random), b_t = unit(random), mu_sign = 0.9 * unit(random);
    const PlanarImpulse<double> s = stick(a, b_n, b_t);
    ASSERT_NEAR(gap_rate_after(a, b_n, s), 0.0, kPlanarSolve);
    ASSERT_NEAR(slip_after(a, b_t, s), 0.0, kPlanarSolve);
    const double n = slide(a, b_n, mu_sign);
    const PlanarImpulse<double> l{n, -mu_sign * n};
    ASSERT_NEAR(gap_rate_after(a, b_n, l), 0.0, kPlanarSolve);
    ASSERT_NEAR(slip_after(a, b_t, l), slip_after_slide(a, b_t, mu_sign, n), kPlanarSolve);
  }
}

// A vector of contacts gives the bits of each contact alone.
TEST(PlanarContact, WorksOnManyContactsAtOnce) {
  struct Pair {
    double x[2];
    Pair operator+(const Pair& o) const { return {{x[0] + o.x[0], x[1] + o.x[1]}}; }
    Pair operator-(const Pair& o) const { return {{x[0] - o.x[0], x[1] - o.x[1]}}; }
    Pair operator*(const Pair& o) const { return {{x[0] * o.x[0], x[1] * o.x[1]}}; }
    Pair operator/(const Pair& o) const { return {{x[0] / o.x[0], x[1] / o.x[1]}}; }
    Pair operator-() const { return {{-x[0], -x[1]}}; }
  };
  const PlanarMatrix<double> one{2.0, 0.1, 0.2, 3.0}, two{1.0, -0.4, 0.3, 0.7};
  const PlanarMatrix<Pair> both{
      {{one.nn, two.nn}}, {{one.nt, two.nt}}, {{one.tn, two.tn}}, {{one.tt, two.tt}}};
  const Pair b_n{{-0.3, 0.2}}, b_t{{0.7, -0.1}}, mu{{0.3, -0.2}};
  const PlanarImpulse<Pair> l = stick(both, b_n, b_t);
  const Pair n = slide(both, b_n, mu);
  for (int i = 0; i < 2; ++i) {
    const PlanarMatrix<double>& a = i == 0 ? one : two;
    EXPECT_EQ(l.normal.x[i], stick(a, b_n.x[i], b_t.x[i]).normal);
    EXPECT_EQ(l.friction.x[i], stick(a, b_n.x[i], b_t.x[i]).friction);
    EXPECT_EQ(n.x[i], slide(a, b_n.x[i], mu.x[i]));
    EXPECT_EQ(slip_after_slide(both, b_t, mu, n).x[i],
              slip_after_slide(a, b_t.x[i], mu.x[i], n.x[i]));
  }
}

}  // namespace
}  // namespace rotorub
