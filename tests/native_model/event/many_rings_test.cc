// Three and more rigid rings, which may hold each other closed: a contact that carries nothing and
// is yet kept on its circle is no event, whatever the order of the list.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"
#include "tests/support/order.h"

namespace rotorub {
namespace {

// Rings at stations (1, s) of a shaft of two modes, pressed at (1, lever) by a constant force (N).
scene::Scene many_rings(const std::vector<double>& stations, double lever,
                        const Eigen::Vector2d& force, double friction = 0.2, double speed = 0.0) {
  scene::Scene s = test::make_scene({.friction = friction, .restitution = 0.5, .speed = speed});
  s.rotor.modal->mass = {2.0, 0.7};
  s.rotor.modal->stiffness = {8e4, 5e4};
  s.rotor.modal->damping = {20.0, 10.0};
  s.auxiliary.assign(stations.size(), s.first());
  for (std::size_t k = 0; k < stations.size(); ++k)
    s.auxiliary[k].contact->shape = {1.0, stations[k]};
  test::add_constant_force(s, force);
  s.forces.back().shape = {1.0, lever};
  s.run.end = 0.1;
  s.run.output_step = 1e-3;
  return s;
}

// Rings at one place are one ring with the sum of their forces.
TEST(ManyRings, AtOnePlaceAreOne) {
  for (const int rings : {2, 3, 4, 5}) {
    for (const double speed : {0.0, 80.0}) {
      const auto of = [&](int count) {
        return many_rings(std::vector<double>(static_cast<std::size_t>(count), 0.0), 0.0,
                          {30.0, -120.0}, 0.2, speed);
      };
      scene::Scene scene = of(rings);
      const Trajectory t = test::run_event(scene), one = test::run_event(of(1));
      ASSERT_EQ(one.status, Status::kOk) << one.message;
      ASSERT_EQ(t.status, Status::kOk) << rings << " " << speed << ": " << t.message;
      ASSERT_GE(one.impacts.size(), 3u);
      EXPECT_LT(test::rotor_error(t, one), 1e-11) << rings << " " << speed;
      EXPECT_NEAR(t.statistics.impulse_total / one.statistics.impulse_total, 1.0, 1e-8)
          << rings << " " << speed;
      EXPECT_LT(t.statistics.energy_residual(), 1e-9);
    }
  }
}

// In a plane two rings leave a shaft of two modes no motion, and the third closes with them or
// carries nothing. The order of the rings beyond the first, to which the modes are scaled, and a
// turn of the scene change nothing.
TEST(ManyRings, TheirOrderAndTheirDirectionDoNotMatter) {
  const std::vector<double> kAngles{0.0, 0.3, 1.0, 2.2};
  for (const double lever : {-0.3, 0.9}) {
    for (const double friction : {0.0, 0.2}) {
      const auto run = [&](std::vector<double> stations, double angle) {
        const Eigen::Vector2d down(std::sin(angle), -std::cos(angle));
        return test::run_event(many_rings(stations, lever, 120.0 * down, friction));
      };
      const Trajectory known = run({0.0, 0.6, -0.5}, 0.0);
      ASSERT_EQ(known.status, Status::kOk) << lever << " " << friction << ": " << known.message;
      EXPECT_LT(known.statistics.energy_residual(), 1e-9);
      const Trajectory other = run({0.0, -0.5, 0.6}, 0.0);
      ASSERT_EQ(other.status, Status::kOk) << lever << " " << friction << ": " << other.message;
      EXPECT_LT(test::rotor_error(other, known), 1e-10) << lever << " " << friction;
      // With friction and no spin the slip of a turned scene is round-off, whose sign is not known.
      for (const double angle : friction > 0.0 ? std::vector<double>{0.0} : kAngles) {
        const Trajectory turned = run({0.0, 0.6, -0.5}, angle);
        ASSERT_EQ(turned.status, Status::kOk)
            << lever << " " << friction << " " << angle << ": " << turned.message;
        double most = 0.0;
        for (std::size_t k = 0; k < known.rows(); ++k) {
          const double along = std::cos(angle) * turned.column("rotor_y")[k] -
                               std::sin(angle) * turned.column("rotor_x")[k];
          most = std::max(most, std::abs(along - known.column("rotor_y")[k]));
        }
        EXPECT_LT(most, 1e-10) << lever << " " << friction << " " << angle;
      }
    }
  }
}

}  // namespace
}  // namespace rotorub
