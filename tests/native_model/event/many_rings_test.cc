// Three and more rigid rings, which may hold each other closed: a contact without a force that is
// still kept on its circle causes no events, in any order of the list.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <random>
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
      ASSERT_GE(one.impacts.size(), 3u);
      EXPECT_LT(test::rotor_error(t, one), 1e-11) << rings << " " << speed;
      EXPECT_NEAR(t.statistics.impulse_total / one.statistics.impulse_total, 1.0, 1e-8)
          << rings << " " << speed;
      EXPECT_LT(t.statistics.energy_residual(), 1e-9);
    }
  }
}

scene::Scene turned(scene::Scene s, double angle) {
  const Eigen::Rotation2D<double> turn(angle);
  for (scene::Force& f : s.forces) f.vector = turn * f.vector;
  for (std::size_t i = 0; i < s.initial.vx.size(); ++i) {
    const Eigen::Vector2d v = turn * Eigen::Vector2d(s.initial.vx[i], s.initial.vy[i]);
    s.initial.vx[i] = v.x(), s.initial.vy[i] = v.y();
  }
  return s;
}

// Of the rotor at the first ring, m; `t` is of a scene that is turned by `angle`.
double error_of_turned(const Trajectory& t, double angle, const Trajectory& known) {
  const Eigen::Rotation2D<double> back(-angle);
  double most = 0.0;
  for (std::size_t k = 0; k < known.rows(); ++k) {
    const Eigen::Vector2d at(t.column("rotor_x")[k], t.column("rotor_y")[k]);
    const Eigen::Vector2d expected(known.column("rotor_x")[k], known.column("rotor_y")[k]);
    most = std::max(most, (back * at - expected).norm());
  }
  return most;
}

// In a plane two rings leave a shaft of two modes no motion, and the third closes with them or
// carries nothing. The order of the rings beyond the first, to which the modes are scaled, and a
// turn of the scene change nothing.
TEST(ManyRings, TheirOrderAndTheirDirectionDoNotMatter) {
  for (const double lever : {-0.3, 0.1, 0.9}) {
    for (const double friction : {0.0, 0.2}) {
      const auto run = [&](std::vector<double> stations, double angle) {
        return test::run_event(turned(many_rings(stations, lever, {0.0, -120.0}, friction), angle));
      };
      const Trajectory known = run({0.0, 0.6, -0.5}, 0.0);
      EXPECT_LT(known.statistics.energy_residual(), 1e-9);
      const Trajectory other = run({0.0, -0.5, 0.6}, 0.0);
      EXPECT_LT(test::rotor_error(other, known), 1e-10) << lever << " " << friction;
      for (const double angle : {0.3, 1.0, 2.2}) {
        const Trajectory t = run({0.0, 0.6, -0.5}, angle);
        EXPECT_LT(error_of_turned(t, angle, known), 1e-10)
            << lever << " " << friction << " " << angle;
      }
    }
  }
}

// Rings at one place, nearly at one place or anywhere, alike or not, whose shaft turns or not:
// every scene runs, and so does its copy with the rings beyond the first in another order, and
// turned.
TEST(ManyRings, RandomOnesRunInEveryOrderAndDirection) {
  constexpr double kAngle = 0.7315;
  std::mt19937 random(3);
  const auto between = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  const auto one_of = [&](std::initializer_list<double> list) {
    return *(list.begin() + random() % list.size());
  };
  for (int k = 0; k < 24; ++k) {
    const double apart = one_of({0.0, 1e-10, 1e-6, 0.5, 0.5}), place = between(-1.0, 1.0);
    std::vector<double> stations{0.0};
    for (int rings = 3 + k % 3; static_cast<int>(stations.size()) < rings;)
      stations.push_back(random() % 3 == 0 ? 0.0 : apart * between(-1.0, 1.0));
    const double direction = one_of({0.0, 0.5, 1.0});
    const Eigen::Vector2d force =
        between(50.0, 400.0) * Eigen::Vector2d(std::cos(direction), std::sin(direction));
    scene::Scene scene = many_rings(stations, place, force, one_of({0.0, 0.1, 0.5}),
                                    one_of({0.0, 0.0, 80.0, -300.0}));
    const double restitution = one_of({0.0, 0.5, 0.8});
    const bool alike = random() % 2 == 0;
    for (scene::AuxiliaryBearing& bearing : scene.auxiliary) {
      scene::Contact& contact = *bearing.contact;
      contact.restitution = alike ? restitution : between(0.0, 0.8);
      if (!alike && !contact.friction.is_frictionless()) contact.friction = between(0.05, 0.6);
    }
    const double across = one_of({0.0, 0.2});
    scene.initial.vx = {across * between(-1.0, 1.0), 0.0};
    scene.initial.vy = {across * between(-1.0, 1.0), 0.0};
    scene.run.end = 0.05;

    scene::Scene reordered = scene;
    std::reverse(reordered.auxiliary.begin() + 1, reordered.auxiliary.end());
    const Trajectory known = test::run_event(scene);
    EXPECT_LT(known.statistics.energy_residual(), 1e-9) << k;
    const Trajectory other = test::run_event(reordered);
    EXPECT_LT(test::rotor_error(other, known), 1e-9) << k;
    const Trajectory t = test::run_event(turned(scene, kAngle));
    EXPECT_LT(error_of_turned(t, kAngle, known), 1e-9) << k;
  }
}

// A shaft that falls flat between two rings without restitution rocks from the one to the other, in
// ever shorter time, until both are closed: an accumulation of impacts that leave no rebound.
TEST(ManyRings, AShaftThatRocksComesToRest) {
  for (const double angle : {0.0, 0.4}) {
    scene::Scene scene = many_rings({0.0, -0.3, 0.4}, 0.05, {0.0, -200.0}, 0.0);
    scene.first().contact->clearance *= 2.0;
    for (scene::AuxiliaryBearing& bearing : scene.auxiliary) bearing.contact->restitution = 0.0;
    const Trajectory t = test::run_event(turned(scene, angle));
    EXPECT_GE(t.impacts.size(), 6u) << angle;
    for (const char* gap : {"contact2_gap", "contact3_gap"})
      EXPECT_NEAR(t.column(gap).back(), 0.0, 1e-14) << angle << " " << gap;
  }
}

}  // namespace
}  // namespace rotorub
