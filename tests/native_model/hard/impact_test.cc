// Many impacts, grazing impacts, and impacts that take time.
#include <gtest/gtest.h>

#include <cmath>

#include "native_model/oracles/bounces.h"
#include "tests/native_model/hard/rules.h"

namespace rotorub {
namespace {

using test::Jeffcott;
using test::make_scene;

int rebounds(const Trajectory& t) {
  return static_cast<int>(
      std::count_if(t.impacts.begin(), t.impacts.end(), [](const Impact& i) { return counts(i); }));
}

// Infinitely many impacts in finite time: contact closes at the time of the geometric series, for
// any eps.
TEST(HardZeno, ClosesAtTheExactTime) {
  for (const double eps : {0.5, 0.9, 0.99}) {
    SCOPED_TRACE(eps);
    scene::Scene scene = make_scene({.mass = 2.0, .restitution = eps});
    test::add_constant_force(scene, {0.0, -19.62});
    const oracle::Drop exact{0.5e-3, 9.81, eps};
    scene.run.end = 1.1 * exact.rest_time();
    const Trajectory t = test::sound_event(scene);
    // The remaining time when the rebounds are below 1e-9 m/s is 2 v / (g (1 - eps)).
    EXPECT_NEAR(t.events.back().t, exact.rest_time(), 2e-9 / 9.81 / (1.0 - eps) + 1e-11);
    EXPECT_EQ(static_cast<Mode>(t.column("mode").back()), Mode::kStick);
    EXPECT_NEAR(t.column("normal_force").back(), 19.62, 1e-9);

    const double step = 1e-5;
    const Trajectory p = test::sound_verlet(scene, step, 0.11);
    // Each rebound is up to a step late, which delays the end; by now the bounces are almost over.
    EXPECT_LT(p.column("gap").back(), 0.03 * 0.5e-3);
    EXPECT_LT(std::abs(p.column("rotor_vy").back()), 0.1 * std::sqrt(2.0 * 9.81 * 0.5e-3));
    EXPECT_GT(rebounds(p), 3);
  }
}

// A path that barely touches the circle, from outside or inside: a straight flight at a distance of
// delta_0 (1 + x) from the centre.
TEST(HardGrazing, NothingIsMissedAndNothingInvented) {
  const double clearance = 0.5e-3;
  for (const double x : {-1e-3, -1e-6, -1e-9, -1e-12, 0.0, 1e-12, 1e-9, 1e-6, 1e-3}) {
    SCOPED_TRACE(x);
    scene::Scene scene = make_scene(
        {.mass = 2.0, .clearance = clearance, .friction = 0.3, .restitution = 0.7, .speed = 10.0});
    // From inside: the turning point of a parabola under a constant force just reaches the ring.
    const double height = clearance * (1.0 + x), pull = 10.0, m = 2.0;
    test::add_constant_force(scene, {0.0, -pull});
    scene.initial.vy = {std::sqrt(2.0 * pull / m * height)};
    scene.run.end = 0.02;
    const Trajectory t = test::sound_event(scene);
    const double top = scene.initial.vy[0] * m / pull;
    const bool touched = t.statistics.first_touch >= 0.0 && t.statistics.first_touch < 1.5 * top;
    if (std::abs(x) >= 1e-12) {
      EXPECT_EQ(touched, x > 0.0);
    }
    test::sound_verlet(scene);
  }
}

// Tangent to the circle at speed: the ends of the chord coincide.
TEST(HardGrazing, AlongTheRing) {
  for (const double angle : {1e-2, 1e-4, 1e-6}) {
    SCOPED_TRACE(angle);
    scene::Scene scene = make_scene({.mass = 2.0, .restitution = 1.0});
    scene.initial.x = {0.5e-3 * (1.0 - 1e-9)};
    scene.initial.vx = {0.2 * std::sin(angle)};
    scene.initial.vy = {0.2 * std::cos(angle)};
    // About 300 chords of 2 delta_0 sin(angle) / v.
    scene.run.end = 300.0 * 2.0 * 0.5e-3 * std::sin(angle) / 0.2;
    scene.run.output_step = scene.run.end / 50.0;
    const Trajectory t = test::sound_event(scene);
    for (std::size_t k = 0; k < t.rows(); ++k) {
      ASSERT_NEAR(std::hypot(t.column("rotor_vx")[k], t.column("rotor_vy")[k]), 0.2, 1e-11);
    }
  }
}

// The centres coincide, so the normal is undefined and must not be needed.
TEST(HardCentre, AtRestAndPushedThroughIt) {
  for (const double speed : {0.0, 0.3}) {
    for (const bool ring : {false, true}) {
      scene::Scene scene = make_scene({.mass = 2.0,
                                       .damping = 5.0,
                                       .stiffness = 1e5,
                                       .friction = 0.3,
                                       .restitution = 0.5,
                                       .speed = 300.0});
      if (ring) test::add_ring(scene, 1.0, 50.0, 1e5);
      scene.initial.vx = {speed};
      scene.run.end = 0.1;
      const Trajectory t = test::sound_event(scene);
      EXPECT_EQ(t.column("gap")[0], 0.5e-3);
      EXPECT_EQ(t.column("gap_rate")[0], 0.0);
      EXPECT_EQ(t.column("slip")[0], 0.05 * 300.0);
      test::sound_verlet(scene);
    }
  }
}

// The clearance of the test rig may also be nearly 0.
TEST(HardCentre, NextToNoClearance) {
  for (const double clearance : {1e-6, 1e-8}) {
    SCOPED_TRACE(clearance);
    scene::Scene scene = make_scene({.mass = 2.0,
                                     .damping = 200.0,
                                     .stiffness = 1e6,
                                     .clearance = clearance,
                                     .friction = 0.2,
                                     .restitution = 0.3,
                                     .speed = 0.0});
    test::add_rotating_force(scene, 100.0, 300.0);
    scene.run.end = 0.01;
    test::sound_event(scene);
    const Trajectory p = test::run_verlet(scene, 1e-6);
    test::expect_refused_or_finite(p);
    EXPECT_LE(p.statistics.max_penetration, 1e-6 * 0.1);
  }
}

// Finite compression and expansion times: the time advances by them, and the path tends to that of
// the instantaneous law, in both integrators.
TEST(HardFiniteImpact, AdvancesTheClockAndTendsToTheInstantaneousLaw) {
  const auto scene_of = [](double tau) {
    scene::Scene scene = make_scene({.mass = 2.0,
                                     .damping = 10.0,
                                     .stiffness = 5e4,
                                     .friction = 0.2,
                                     .restitution = 0.6,
                                     .speed = 150.0});
    test::add_constant_force(scene, {40.0, 10.0});
    scene.initial.vx = {0.3};
    scene.first().contact->compression_time = tau;
    scene.first().contact->expansion_time = 1.5 * tau;
    scene.run.end = 0.004;  // the first impact and some flight
    scene.run.output_step = 1e-4;
    return scene;
  };
  const scene::Scene instant = scene_of(0.0);
  const Trajectory limit = test::sound_event(instant);
  ASSERT_GE(limit.impacts.size(), 1u);
  double last_event = 1.0;
  for (const double tau : {1e-5, 1e-6, 1e-7}) {
    SCOPED_TRACE(tau);
    const scene::Scene scene = scene_of(tau);
    const Trajectory t = test::run_event(scene);
    test::expect_finite(t);
    ASSERT_GE(t.impacts.size(), 1u);
    EXPECT_NEAR(t.impacts[0].t, limit.impacts[0].t, 1e-12) << "begins at the touch";
    const double error = std::hypot(t.column("rotor_x").back() - limit.column("rotor_x").back(),
                                    t.column("rotor_y").back() - limit.column("rotor_y").back());
    EXPECT_LT(error, 0.2 * last_event) << "first order in tau";
    EXPECT_LT(error, 2.0 * tau) << "a flight of some m/s over tau";
    last_event = error;
    // A fixed step that treated it as an impact within the step would tend to another model.
    EXPECT_THROW(test::run_with(scene, scene::Integrator::kEuler, 1e-6), scene::SceneError);
  }
}

// The loads do work during the impact, even through an accumulation: the balance closes for any
// duration.
TEST(HardFiniteImpact, TheBalanceCloses) {
  for (const double tau : {1e-4, 1e-5, 1e-6, 1e-7}) {
    SCOPED_TRACE(tau);
    scene::Scene scene = test::shipped("bench_ring");
    scene.run.end = 0.05;
    scene.first().contact->compression_time = scene.first().contact->expansion_time = tau;
    const Trajectory t = test::run_event(scene);
    test::expect_finite(t);
    EXPECT_LT(t.statistics.energy_residual(), test::kEnergy);
  }
}

// An impact may cover the instant of a sample; the controller continues to sample, and the run
// reaches its end.
TEST(HardFiniteImpact, PassesASampleAndNotTheEnd) {
  scene::Scene scene = test::shipped("bench_ring");
  scene.first().actuator = scene::Actuator{.force_limit = 100.0};
  scene::Controller controller;
  controller.stiffness = 2e4;
  controller.damping = 50.0;
  controller.sample_time = 1e-4;
  scene.first().controller = controller;
  scene.first().contact->compression_time = 2e-4;
  scene.first().contact->expansion_time = 1e-4;
  scene.run.end = 0.02;
  scene.run.output_step = 2.5e-4;
  const Trajectory t = test::run_event(scene);
  test::expect_finite(t);
  EXPECT_EQ(t.end, scene.run.end);
  ASSERT_GE(t.impacts.size(), 1u);
  const auto& control = t.column("control_x");
  EXPECT_NE(control[control.size() - 1], control[control.size() - 2]) << "still sampled";
}

}  // namespace
}  // namespace rotorub
