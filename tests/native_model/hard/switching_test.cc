// Loads and commands that switch must not affect the step before the switch, in flight or in
// contact.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/native_model/hard/rules.h"

namespace rotorub {
namespace {

using test::Jeffcott;
using test::make_scene;

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

TEST(HardSwitching, InContactOffOnAndRamp) {
  for (const double ramp : {0.0, 0.004}) {
    scene::Scene scene = pressed();
    scene.forces[0].off = 0.04;
    test::add_constant_force(scene, {0.0, 40.0});
    scene.forces[1].on = 0.04;
    scene.forces[1].ramp = ramp;
    const Trajectory t = test::sound_event(scene);
    EXPECT_GT(t.contact_fraction(), 0.2);
    const Trajectory p = test::sound_verlet(scene, 1e-6, 2.0);
    EXPECT_NEAR(p.column("rotor_x").back(), t.column("rotor_x").back(), 2e-5);
    EXPECT_NEAR(p.statistics.impulse_total, t.statistics.impulse_total,
                0.01 * t.statistics.impulse_total);
  }
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

// Control that is switched on 4 ms before contact, as in the published rig.
TEST(HardSwitching, ControlFourMillisecondsBeforeContact) {
  scene::Scene scene = test::shipped_rig("paper_sliding");
  scene::Scene passive = scene;
  passive.first().controller.reset();
  passive.run.end = scene.run.end = 0.2;
  const double touch = test::run_event(passive).statistics.first_touch;
  ASSERT_GT(touch, 0.1);
  scene.first().controller->on = touch - 0.004;
  const Trajectory t = test::sound_event(scene);
  EXPECT_GT(t.statistics.first_touch, scene.first().controller->on);
  const Trajectory p = test::sound_verlet(scene, 1e-5, 5.0);
  EXPECT_NEAR(p.statistics.first_touch, t.statistics.first_touch, 5e-5);
}

// Each command is limited on its own axis; the run continues through saturation.
TEST(HardSwitching, SaturatedActuator) {
  scene::Scene scene = test::shipped_rig("paper_sliding");
  scene.run.end = 0.2;
  for (const double limit : {5.0, 40.0}) {
    scene.first().actuator = scene::Actuator{.force_limit = limit};
    const Trajectory t = test::sound_event(scene);
    double most = 0.0;
    for (std::size_t k = 0; k < t.rows(); ++k) {
      const double x = t.column("control_x")[k], y = t.column("control_y")[k];
      most = std::max({most, std::abs(x + y) / std::sqrt(2.0), std::abs(y - x) / std::sqrt(2.0)});
    }
    EXPECT_NEAR(most, limit, 1e-9 * limit) << "it saturates, and not beyond";
    test::sound_verlet(scene, 1e-5, 5.0);
  }
}

}  // namespace
}  // namespace rotorub
