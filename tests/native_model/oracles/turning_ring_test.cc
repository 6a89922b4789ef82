// The ring that turns, put back into the equations that its closed forms solve.
#include "tests/support/oracles/turning_ring.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace rotorub::oracle {
namespace {

TEST(TurningRing, SlidingSolvesTheEquationOfMotion) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int k = 0; k < 200; ++k) {
    const TurningRing ring{1e-4 + 1e-3 * unit(random), 1e-2 * unit(random), 0.05};
    const double torque = 4.0 * unit(random) - 2.0, start = 200.0 * unit(random) - 100.0;
    const double t = 0.2 * unit(random), h = 1e-6;
    const auto speed = [&](double at) { return ring_speed(ring, torque, start, at); };
    const double rate = (speed(t + h) - speed(t)) / h;
    const double right = (torque - ring.drag * speed(t + 0.5 * h)) / ring.inertia;
    EXPECT_NEAR(rate, right, 1e-6 * (std::abs(torque) / ring.inertia + std::abs(right) + 1.0)) << k;
    EXPECT_EQ(speed(0.0), start);
  }
}

TEST(TurningRing, WithoutDragTheSpeedGrowsEvenlyAndWithItTendsToABalance) {
  const TurningRing free{2e-3, 0.0, 0.05}, held{2e-3, 1e-2, 0.05};
  EXPECT_DOUBLE_EQ(ring_speed(free, 0.4, 3.0, 0.5), 3.0 + 0.4 / 2e-3 * 0.5);
  EXPECT_DOUBLE_EQ(ring_speed(held, 0.4, 3.0, 1e3), 0.4 / 1e-2);
  // A drag that is next to none.
  const TurningRing nearly{2e-3, 1e-12, 0.05};
  EXPECT_NEAR(ring_speed(nearly, 0.4, 3.0, 0.5), ring_speed(free, 0.4, 3.0, 0.5), 1e-7);
}

// An impulse P of friction, found from J (Omega' - Omega) = -r P, J_r (Omega_r' - Omega_r) = R P
// and equal surface speeds.
TEST(TurningRing, RollingSurfacesMeet) {
  const FreeSpin rotor{1e-3, 0.05, 314.0};
  const TurningRing ring{4e-4, 0.0, 0.0505};
  const double start = -20.0, r = rotor.radius, R = ring.bore_radius;
  const double slip = r * rotor.speed - R * start;
  const double impulse = slip / (r * r / rotor.inertia + R * R / ring.inertia);
  const double of_rotor = r * (rotor.speed - r * impulse / rotor.inertia);
  const double of_ring = R * (start + R * impulse / ring.inertia);
  EXPECT_NEAR(of_rotor, of_ring, 1e-13);
  EXPECT_NEAR(rolling_surface_speed(rotor, ring, start), of_rotor, 1e-13);
}

}  // namespace
}  // namespace rotorub::oracle
