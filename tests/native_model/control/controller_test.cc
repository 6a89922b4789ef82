// Which controller a scene makes, the emulated support, and sampling.
#include "native_model/control/controller.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "native_model/control/ring_feedback.h"
#include "native_model/control/sliding.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/run/run_native.h"
#include "native_model/scene/reader.h"
#include "native_model/system/actuation.h"
#include "tests/support/jeffcott.h"
#include "tests/support/machine.h"

namespace rotorub {
namespace {

scene::Scene with_controller(scene::ControllerKind kind) {
  scene::Scene s = test::machine_scene(true);
  s.first().controller = scene::Controller{};
  s.first().controller->kind = kind;
  return s;
}

TEST(MakeController, PassiveWithoutEmulationIsNone) {
  EXPECT_EQ(make_controller(test::machine_scene(true), {}), nullptr);
  const scene::Scene s = with_controller(scene::ControllerKind::kPassive);
  EXPECT_EQ(make_controller(s, {}), nullptr);
  EXPECT_EQ(make_model(s).first().controller, nullptr) << "and costs nothing";
}

TEST(MakeController, OneOfItsKind) {
  scene::Scene s = with_controller(scene::ControllerKind::kPassive);
  s.first().controller->stiffness = 1.0;
  EXPECT_NE(dynamic_cast<const EmulatedSupport*>(make_controller(s, {}).get()), nullptr);
  s = with_controller(scene::ControllerKind::kSliding);
  const auto sliding = make_controller(s, {});
  ASSERT_NE(dynamic_cast<const SlidingController*>(sliding.get()), nullptr);
  EXPECT_TRUE(sliding->needs_rotor_acceleration());
}

TEST(EmulatedSupport, IsTheMechanicalOneAddedThroughTheActuator) {
  scene::Scene emulated = with_controller(scene::ControllerKind::kPassive);
  emulated.first().controller->stiffness = 5e4;
  emulated.first().controller->damping = 120.0;
  scene::Scene mechanical = test::machine_scene(true);
  mechanical.first().stator->stiffness += Eigen::Vector2d(5e4, 5e4);
  mechanical.first().stator->damping += Eigen::Vector2d(120.0, 120.0);
  const Model a = make_model(emulated), b = make_model(mechanical);
  const State s = test::random_state(a, 70);
  const Eigen::Vector2d u = control_command(a, s.t, s.q.data(), s.v.data());
  Eigen::VectorXd fa(a.nq()), fb(b.nq());
  smooth_force(a, s.t, s.q.data(), s.v.data(), u, fa.data());
  smooth_force(b, s.t, s.q.data(), s.v.data(), {0.0, 0.0}, fb.data());
  EXPECT_LT((fa - fb).norm(), 1e-12 * fb.norm());
}

TEST(EmulatedSupport, ActsWithoutAContactToo) {
  scene::Scene s = with_controller(scene::ControllerKind::kPassive);
  s.first().controller->stiffness = 5e4;
  s.first().contact.reset();
  const Model m = make_model(s);
  ASSERT_NE(m.first().controller, nullptr);
  State state = test::random_state(m, 71);
  state.q.segment<2>(m.layout.ring()) = Eigen::Vector2d(1e-3, -2e-3);
  const Eigen::Vector2d u = control_command(m, 0.0, state.q.data(), state.v.data());
  EXPECT_LT((u - Eigen::Vector2d(-50.0, 100.0)).norm(), 1e-12);
}

// A ring that swings by itself under an emulated support, sampled every 1 ms from 4 ms on.
scene::Scene sampled_scene(scene::Integrator integrator) {
  scene::Scene s = test::make_scene({.stiffness = 2e5});
  test::add_ring(s, 1.0, 20.0, 1e5);
  s.first().stator->position = {1e-4, 2e-4};
  s.first().controller = scene::Controller{};
  s.first().controller->stiffness = 1e5;
  s.first().controller->on = 0.004;
  s.first().controller->sample_time = 1e-3;
  s.run.end = 0.012;
  s.run.step = 1e-5;
  s.run.integrator = integrator;
  s.run.output_step = 1e-4;
  return s;
}

void expect_hold(scene::Integrator integrator) {
  const Trajectory t = run_native(sampled_scene(integrator));
  ASSERT_EQ(t.status, Status::kOk) << t.message;
  const auto &x = t.column("control_x"), &ring = t.column("stator_x");
  // The row of a sample may show the command before or after it; rows between show the one held.
  for (std::size_t sample = 4; sample < 12; ++sample) {
    const std::size_t first = 10 * sample;
    EXPECT_NEAR(x[first + 5], -1e5 * ring[first], 1e-3) << "as measured at the sample";
    for (std::size_t row = first + 1; row < first + 10; ++row) {
      EXPECT_EQ(x[row], x[first + 5]) << row;
    }
  }
  for (std::size_t row = 0; row < 40; ++row) EXPECT_EQ(x[row], 0.0) << "before it is on";
}

TEST(SampledController, VerletHoldsBetweenSamples) { expect_hold(scene::Integrator::kVerlet); }
TEST(SampledController, EventHoldsBetweenSamples) { expect_hold(scene::Integrator::kEvent); }

// The time of the first row with a command.
double first_command(const Trajectory& t) {
  const auto& x = t.column("control_x");
  const auto at = std::find_if(x.begin(), x.end(), [](double u) { return u != 0.0; });
  return at == x.end() ? -1.0 : t.column("t")[static_cast<std::size_t>(at - x.begin())];
}

TEST(SampledController, BothIntegratorsStartAtTheSameInstant) {
  // Switched on between two samples.
  scene::Scene verlet = sampled_scene(scene::Integrator::kVerlet),
               event = sampled_scene(scene::Integrator::kEvent);
  verlet.first().controller->on = event.first().controller->on = 0.0043;
  EXPECT_NEAR(first_command(run_native(verlet)), first_command(run_native(event)), 1.01e-4);
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
  s.run.integrator = scene::Integrator::kEvent;
  const Trajectory t = run_native(s);
  ASSERT_EQ(t.status, Status::kOk) << t.message;
  for (std::size_t row = t.rows() / 2; row < t.rows(); row += 50) {
    EXPECT_NEAR(t.column("normal_force")[row], 20.0, 2e-5) << t.column("t")[row];
    EXPECT_NEAR(t.column("gap")[row], 0.0, 1e-12);
  }
}

scene::Scene sliding_rig() {
  return scene::read_scene(std::string(ROTORUB_MJCF_DIR) + "/paper_sliding.toml");
}

// The reference rig from the switch-on to 50 ms after the touch, with so many of its modes.
Trajectory rig_with(int modes) {
  scene::Scene s = sliding_rig();
  s.rotor.geometry->modes = modes;
  s.run.end = 0.157;
  s.run.integrator = scene::Integrator::kEvent;
  const Trajectory t = run_native(s);
  EXPECT_EQ(t.status, Status::kOk) << modes << ": " << t.message;
  return t;
}

// s, from the first touch.
double time_apart(const Trajectory& t) {
  return (1.0 - t.contact_fraction()) * (t.end - t.statistics.first_touch);
}

// The more modes, the less the rotor weighs at the contact: 1.2 kg with 2, 0.30 kg with 12. Where
// the law gives the actuator the preload itself, the contact keeps 10.4 N of 20 N with 2, 3.3 N
// with 12.
TEST(SlidingController, ForceDoesNotHangOnTheModesOfItsPlant) {
  for (const int modes : {2, 6, 10}) {
    SCOPED_TRACE(modes);
    const Trajectory t = rig_with(modes);
    const double preload = sliding_rig().first().controller->preload;
    EXPECT_NEAR(t.mean_force(), preload, 0.03 * preload);
    EXPECT_LT(time_apart(t), 1e-3) << "it bounces for a moment, then stays";
    EXPECT_LT(std::count_if(t.impacts.begin(), t.impacts.end(), counts), 12);
  }
}

TEST(SlidingControllerLong, ForceDoesNotHangOnTheModesOfItsPlant) {
  const double few = rig_with(8).mean_force();
  for (const int modes : {12, 20, 30}) {
    const Trajectory t = rig_with(modes);
    EXPECT_NEAR(t.mean_force(), few, 0.02 * few) << modes;
    EXPECT_LT(time_apart(t), 1e-3) << modes;
  }
}

}  // namespace
}  // namespace rotorub
