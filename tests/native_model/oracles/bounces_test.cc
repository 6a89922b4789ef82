// The closed forms of flights against brute force: flight to the circle, reflection, flight.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "native_model/oracles/bounces.h"
#include "tests/support/oracles/planar_impact.h"

namespace rotorub::oracle {
namespace {

// A point that flies and is reflected, one chord after another.
struct BruteForce {
  double radius;
  Eigen::Vector2d p, v;
  double t = 0.0;
  int impacts = 0;

  double time_to_circle() const {
    // Bisection on |p + s v| = radius, from the chord's middle on: no formula shared.
    double inside = std::max(0.0, -p.dot(v) / v.squaredNorm()), outside = 4.0 * radius / v.norm();
    for (int k = 0; k < 200; ++k) {
      const double middle = 0.5 * (inside + outside);
      ((p + middle * v).norm() < radius ? inside : outside) = middle;
    }
    return inside;
  }
  void fly_until(double end) {
    for (double s = time_to_circle(); t + s <= end; s = time_to_circle()) {
      p += s * v;
      t += s;
      const Eigen::Vector2d n = p.normalized();
      v -= 2.0 * v.dot(n) * n;
      ++impacts;
    }
    p += (end - t) * v;
    t = end;
  }
};

void expect_same(const Eigen::Vector2d& p, const Eigen::Vector2d& v) {
  const double radius = 0.5e-3;
  const Billiard exact(radius, p, v);
  BruteForce brute{radius, p, v};
  for (double t = 0.0; t < 0.05; t += 3.7e-4) {
    brute.fly_until(t);
    // A reflection turns round-off of the place into the direction: it grows with the impacts.
    const double tolerance = 1e-13 * radius * (1.0 + std::pow(brute.impacts, 2));
    ASSERT_EQ(exact.impacts_until(t), brute.impacts) << t;
    ASSERT_LT((exact.position(t) - brute.p).norm(), 10 * tolerance) << t;
    ASSERT_LT((exact.velocity(t) - brute.v).norm(), 10 * tolerance * v.norm() / radius) << t;
  }
}

TEST(Billiard, AgreesWithBruteForce) {
  expect_same({1e-4, 0.0}, {0.3, 0.4});   // the bench
  expect_same({1e-4, 0.0}, {0.3, -0.4});  // turning the other way
  expect_same({-2e-4, 3e-4}, {0.1, 0.02});
  expect_same({4.9e-4, 0.0}, {0.01, 0.5});  // nearly grazing: many impacts
}

TEST(Billiard, ThroughTheCentreGoesToAndFro) {
  const Billiard exact(0.5e-3, {0.0, 0.0}, {0.5, 0.0});
  EXPECT_DOUBLE_EQ(exact.first_impact(), 1e-3);
  EXPECT_DOUBLE_EQ(exact.chord_time(), 2e-3);
  for (const double t : {0.4e-3, 1.7e-3, 3.2e-3, 6.9e-3}) {
    // A saw-tooth.
    const double along = 0.5 * t / 0.5e-3 + 1.0, phase = std::fmod(along, 4.0);
    const double x = 0.5e-3 * (phase < 2.0 ? phase - 1.0 : 3.0 - phase);
    EXPECT_NEAR(exact.position(t).x(), x, 1e-17) << t;
    EXPECT_NEAR(exact.position(t).y(), 0.0, 1e-17) << t;
  }
}

// Bounces one after another: speed at the ground from the fall, then e times that.
TEST(Drop, ImpactTimesAreTheSumOfFlights) {
  const Drop drop{0.5e-3, 9.81, 0.5};
  double t = std::sqrt(2.0 * 0.5e-3 / 9.81), speed = std::sqrt(2.0 * 9.81 * 0.5e-3);
  for (int k = 0; k < 30; ++k) {
    EXPECT_NEAR(drop.impact_time(k), t, 1e-16) << k;
    speed *= 0.5;
    t += 2.0 * speed / 9.81;
  }
  EXPECT_NEAR(drop.rest_time(), t, 1e-9 * t);
  EXPECT_LT(drop.impact_time(30), drop.rest_time()) << "never reached by bouncing";
}

TEST(Drop, TheBenchsFirstImpacts) {
  const Drop drop{0.5e-3, 9.81, 0.5};
  EXPECT_NEAR(drop.impact_time(0), 10.0964e-3, 0.5e-7);
  EXPECT_NEAR(drop.impact_time(1), 20.1928e-3, 0.5e-7);
  EXPECT_NEAR(drop.impact_time(2), 25.2409e-3, 0.5e-7);
}

TEST(Drop, HeightObeysItsEquationBetweenImpacts) {
  const Drop drop{0.3, 9.81, 0.8};
  const double h = 1e-5;
  for (int k = 0; k < 12; ++k) {
    const double from = k == 0 ? 0.0 : drop.impact_time(k - 1), to = drop.impact_time(k);
    const double t = from + 0.37 * (to - from);
    const double second =
        (drop.height_at(t - h) - 2.0 * drop.height_at(t) + drop.height_at(t + h)) / (h * h);
    EXPECT_NEAR(second, -9.81, 1e-4) << k;
    EXPECT_NEAR(drop.height_at(to), 0.0, 1e-13) << k;
    // Restitution: the speed after over that before.
    const double before = -drop.height_at(to - h) / h, after = drop.height_at(to + h) / h;
    EXPECT_NEAR(after / -before, 0.8, 1e-3) << k;
    EXPECT_GT(drop.height_at(t), 0.0);
  }
}

TEST(Drop, RestsAfterwards) {
  const Drop drop{0.5e-3, 9.81, 0.5};
  EXPECT_EQ(drop.height_at(drop.rest_time() * 1.0001), 0.0);
  const Drop plastic{0.5e-3, 9.81, 0.0};
  EXPECT_EQ(plastic.rest_time(), plastic.fall_time());
  EXPECT_EQ(plastic.impact_time(5), plastic.fall_time());
}

// ---------------------------------------------------------------- planar impact
// The impact's closed form against Routh's: the impulse grows bit by bit, Coulomb's law holds at
// every bit.

struct After {
  double normal, slip;
};

// Compression until the bodies no longer close, then restitution times that impulse more (Poisson).
After by_increments(const PlanarImpact& p, double normal, double slip, int parts) {
  const double whole = -normal / p.g_nn * (1.0 + p.restitution), bit = whole / parts;
  for (int k = 0; k < parts; ++k) {
    normal += p.g_nn * bit;
    // Friction takes what it may, and no more than stops the slip.
    const double most = p.friction * p.g_tt * bit;
    slip -= std::clamp(slip, -most, most);
  }
  return {normal, slip};
}

TEST(PlanarImpact, WithoutTangentialRestitutionIsRouths) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int stuck = 0, slid = 0;
  for (int k = 0; k < 500; ++k) {
    const PlanarImpact p{0.2 + unit(random), 0.2 + unit(random), unit(random), unit(random), 0.0};
    const double normal = -0.1 - unit(random), slip = 2.0 * unit(random) - 1.0;
    const After exact = by_increments(p, normal, slip, 2000);
    ASSERT_NEAR(p.normal_after(normal), exact.normal, 1e-11) << k;
    ASSERT_NEAR(p.slip_after(normal, slip), exact.slip, 1e-11) << k;
    ++(p.sticks(normal, slip) ? stuck : slid);
  }
  EXPECT_GT(stuck, 100);
  EXPECT_GT(slid, 100);
}

}  // namespace
}  // namespace rotorub::oracle
