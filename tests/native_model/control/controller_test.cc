// The emulated support, and the preload of the sliding law.
#include "native_model/control/controller.h"
#include "native_model/prepare/prepare.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "native_model/model/actuation.h"
#include "native_model/model/dynamics.h"
#include "tests/support/jeffcott.h"
#include "tests/support/machine.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

scene::Scene emulating() {
  scene::Scene s = test::machine_scene(true);
  s.first().controller = scene::Controller{};
  s.first().controller->stiffness = 5e4;
  return s;
}

TEST(EmulatedSupport, IsTheMechanicalOneAddedThroughTheActuator) {
  scene::Scene emulated = emulating();
  emulated.first().controller->damping = 120.0;
  scene::Scene mechanical = test::machine_scene(true);
  mechanical.first().stator->stiffness += Eigen::Vector2d(5e4, 5e4);
  mechanical.first().stator->damping += Eigen::Vector2d(120.0, 120.0);
  const Model a = prepare(emulated), b = prepare(mechanical);
  const State s = test::random_state(a, 70);
  const Eigen::Vector2d u = control_command(a, s.t, s.q.data(), s.v.data());
  Eigen::VectorXd fa(a.nq()), fb(b.nq());
  smooth_force(a, s.t, s.q.data(), s.v.data(), u, fa.data());
  smooth_force(b, s.t, s.q.data(), s.v.data(), {0.0, 0.0}, fb.data());
  EXPECT_LT((fa - fb).norm(), 1e-12 * fb.norm());
}

TEST(EmulatedSupport, ActsWithoutAContactToo) {
  scene::Scene s = emulating();
  s.first().contact.reset();
  const Model m = prepare(s);
  ASSERT_NE(m.first().controller, nullptr);
  State state = test::random_state(m, 71);
  state.q.segment<2>(m.layout.ring()) = Eigen::Vector2d(1e-3, -2e-3);
  const Eigen::Vector2d u = control_command(m, 0.0, state.q.data(), state.v.data());
  EXPECT_LT((u - Eigen::Vector2d(-50.0, 100.0)).norm(), 1e-12);
}

TEST(SlidingController, LastingContactCarriesThePreload) {
  // Ring 1.5 kg and rotor 2 kg move as one, whatever the orbit. The free orbit, 1.6 mm, is past the
  // clearance.
  scene::Scene s = test::make_scene({.damping = 60.0, .stiffness = 2e5, .friction = 0.1});
  test::add_ring(s, 1.5, 300.0, 2e5);
  test::add_rotating_force(s, 60.0, 300.0);
  s.rotor.speed = 300.0;
  s.first().controller = scene::Controller{};
  s.first().controller->kind = scene::ControllerKind::kSliding;
  s.first().controller->on = 0.02;
  s.first().controller->preload = 20.0;
  s.initial.x = {4e-4};
  s.run.end = 0.2;
  const Trajectory t = test::run_event(s);
  ASSERT_EQ(t.status, Status::kOk) << t.message;
  for (std::size_t row = t.rows() / 2; row < t.rows(); row += 50) {
    EXPECT_NEAR(t.column("normal_force")[row], 20.0, 2e-5) << t.column("t")[row];
    EXPECT_NEAR(t.column("gap")[row], 0.0, 1e-12);
  }
}

// The reference rig from the switch-on to 50 ms after the touch. The more modes, the less the rotor
// weighs at the contact: 1.2 kg with 2, 0.30 kg with 12. Where the law gives the actuator the
// preload itself, the contact keeps 10.4 N of 20 N with 2, 3.3 N with 12.
TEST(SlidingController, ForceDoesNotHangOnTheModesOfItsPlant) {
  for (const int modes : {2, 6, 10}) {
    SCOPED_TRACE(modes);
    scene::Scene s = test::shipped("paper_sliding", {"run.end=0.157"});
    s.rotor.geometry->modes = modes;
    const Trajectory t = test::run_event(s);
    ASSERT_EQ(t.status, Status::kOk) << t.message;
    const double preload = s.first().controller->preload;
    EXPECT_NEAR(t.mean_force(), preload, 0.03 * preload);
    const double apart = (1.0 - t.contact_fraction()) * (t.end - t.statistics.first_touch);
    EXPECT_LT(apart, 1e-3) << "it bounces for a moment, then stays";
    EXPECT_LT(std::count_if(t.impacts.begin(), t.impacts.end(), counts), 12);
  }
}

}  // namespace
}  // namespace rotorub
