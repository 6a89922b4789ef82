// The chords against brute force: flight to the circle, reflection, flight.
#include "native_model/oracles/billiard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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

TEST(Billiard, ARegularPolygonComesBack) {
  // Angle of incidence 45 degrees: a square.
  const double r = 1.0;
  const Eigen::Vector2d start{0.0, -std::sqrt(0.5)};
  const Billiard exact(r, start, {1.0, 0.0});
  EXPECT_NEAR(exact.chord_time(), std::sqrt(2.0), 1e-14);
  const double round = 4.0 * std::sqrt(2.0);
  EXPECT_LT((exact.position(round) - start).norm(), 1e-14);
  EXPECT_EQ(exact.impacts_until(round), 4);
}

TEST(Billiard, KeepsSpeedAndAngularMomentum) {
  const Billiard exact(0.5e-3, {1e-4, 0.0}, {0.3, 0.4});
  for (double t = 0.0; t < 1.0; t += 0.0137) {
    const Eigen::Vector2d p = exact.position(t), v = exact.velocity(t);
    EXPECT_NEAR(v.norm(), 0.5, 1e-14);
    EXPECT_NEAR(p.x() * v.y() - p.y() * v.x(), 4e-5, 1e-16);
    EXPECT_LE(p.norm(), 0.5e-3 * (1.0 + 1e-12));
  }
}

}  // namespace
}  // namespace rotorub::oracle
