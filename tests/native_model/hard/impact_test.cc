// Grazing impacts, impacts that take time, and loads that switch, in flight or in contact.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/native_model/hard/rules.h"

namespace rotorub {
namespace {

using test::Jeffcott;
using test::make_scene;

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

// ---------------------------------------------------------------- loads that switch
// They must not affect the step before the switch.

// A free mass under a constant force until t = off: a polynomial before, a straight line after. A
// step that saw the jump would need thousands of tiny ones to get past it.
TEST(HardSwitching, AForceThatEndsCostsNoSteps) {
  scene::Scene scene = make_scene({.mass = 2.0, .clearance = 1.0});
  test::add_constant_force(scene, {3.0, 0.0});
  scene.forces[0].off = 0.01;
  scene.run.end = 0.02;
  const Trajectory t = test::sound_event(scene);
  const double a = 1.5, off = 0.01, exact = 0.5 * a * off * off + a * off * 0.01;
  EXPECT_NEAR(t.column("rotor_x").back(), exact, 1e-15 * 100.0 * exact);
  EXPECT_LT(t.steps, 40);
}

// The ring carries the rotor; the load that presses it there is switched off, on and ramped.
scene::Scene pressed() {
  scene::Scene scene = make_scene({.mass = 2.0,
                                   .damping = 10.0,
                                   .stiffness = 1e4,
                                   .friction = 0.3,
                                   .restitution = 0.4,
                                   .speed = 200.0});
  test::add_ring(scene, 1.0, 100.0, 2e5);
  test::add_constant_force(scene, {30.0, 0.0});
  scene.run.end = 0.1;
  return scene;
}

// Also if the switch is at the very instant at which contact ends.
TEST(HardSwitching, AtTheInstantOfAnEvent) {
  scene::Scene scene = pressed();
  scene.forces[0].off = 0.04;
  const Trajectory first = test::run_event(scene);
  int checked = 0;
  for (const Event& event : first.events) {
    if (event.t <= 0.0 || event.t >= 0.04 || checked >= 12) continue;
    scene::Scene changed = scene;
    test::add_constant_force(changed, {0.0, 5.0});
    for (const double t : {std::nextafter(event.t, 0.0), event.t, std::nextafter(event.t, 1.0)}) {
      changed.forces[1].on = t;
      SCOPED_TRACE(t);
      test::sound_event(changed);
    }
    ++checked;
  }
  EXPECT_GT(checked, 3);
}

}  // namespace
}  // namespace rotorub
