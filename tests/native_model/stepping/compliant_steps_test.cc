// Compliant contacts in fixed steps: against `event`, of second order through every touch.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "native_model/contact/compliance.h"
#include "native_model/prepare/prepare.h"
#include "native_model/stepping/step_limit.h"
#include "tests/support/jeffcott.h"
#include "tests/support/order.h"
#include "tests/support/refusal.h"

namespace rotorub {
namespace {

using scene::Integrator;
using test::make_scene;
using test::run_event;
using test::run_with;

// A rotor that spins freely on a spring, thrown into its own ring.
scene::Scene thrown(const Compliance& compliance, double friction) {
  scene::Scene s = make_scene(
      {.damping = 20.0, .stiffness = 4e4, .friction = friction, .restitution = 0.7, .speed = 20.0});
  s.rotor.modal->inertia = 2e-3;
  s.drive = scene::Drive{};
  test::add_ring(s, 0.8, 50.0, 1e5);
  s.first().contact->compliance = compliance;
  s.initial.vx = {0.3};
  s.initial.vy = {0.2};
  s.run.end = 0.02;
  return s;
}

struct Law {
  std::string name;
  Compliance compliance;
  double friction;
};
const std::vector<Law> kLaws{
    {"line, by restitution", {.stiffness = 4e6}, 0.0},
    {"line, sliding and sticking", {.stiffness = 4e6}, 0.2},
    {"Hertz, by restitution", {.stiffness = 4e8, .exponent = 1.5}, 0.2},
    {"Hertz, given a", {.stiffness = 4e8, .exponent = 1.5, .hunt_crossley = 0.4}, 0.05},
    {"spring and damper", {.stiffness = 4e6, .damping = 1500.0}, 0.2},
};

TEST(CompliantSteps, AreOfSecondOrderThroughEveryTouch) {
  for (const Law& law : kLaws) {
    const scene::Scene s = thrown(law.compliance, law.friction);
    const Trajectory exact = run_event(s);
    ASSERT_GE(exact.impacts.size(), 2u) << law.name;
    std::vector<double> errors;
    for (const double h : {4e-6, 2e-6, 1e-6, 5e-7}) {
      const Trajectory t = run_with(s, Integrator::kVerlet, h);
      errors.push_back(test::trajectory_error(t, exact, s.first().contact->radius));
    }
    const double order = std::log2(errors.front() / errors.back()) / 3.0;
    EXPECT_GT(order, 1.9) << law.name << " " << errors[0] << " " << errors[1] << " " << errors[2]
                          << " " << errors[3];
  }
}

// A rotor that rolls in the wall, to and fro at its bottom, while a load presses and releases it.
scene::Scene rolling(const Compliance& compliance) {
  scene::Scene s = thrown(compliance, 0.9);
  s.rotor.speed = 0.0;
  s.initial = {};
  test::add_constant_force(s, {150.0, -400.0});
  test::add_rotating_force(s, 60.0, 700.0);
  s.run.end = 0.04;
  return s;
}

// Slip was measured along the circle where the step sees the centre, half a step from where it is
// 0: of first order from where the contact sticks on.
TEST(CompliantSteps, KeepTheirOrderWhileTheyStick) {
  for (const Law& law : kLaws) {
    const scene::Scene s = rolling(law.compliance);
    const Trajectory exact = run_event(s);
    const std::vector<double>& modes = exact.column("mode");
    const auto stuck = std::ranges::count(modes, static_cast<double>(ContactMode::kStick));
    ASSERT_GE(stuck, std::ssize(modes) / 4) << law.name;
    SCOPED_TRACE(law.name);
    test::expect_order_of_steps(
        s, {1e-5, 5e-6, 2.5e-6, 1.25e-6, 6.25e-7}, 1.6, [&](const Trajectory& t) {
          return test::trajectory_error(t, exact, s.first().contact->radius);
        });
  }
}

// The second contact is touched while the first presses: the speed of that touch, and with it the
// damping by the restitution, was taken from the path without the first one's force, an error of
// the order of the step.
TEST(CompliantSteps, KeepTheirOrderWhereOneIsTouchedWhileAnotherPresses) {
  scene::Scene s = make_scene({.mass = 2.0, .stiffness = 2e5, .restitution = 0.4});
  s.auxiliary.push_back(s.first());
  s.auxiliary[1].contact->shape = {1.0};
  s.auxiliary[0].contact->clearance = 2e-4;
  s.auxiliary[1].contact->clearance = 1.9e-4;
  s.auxiliary[0].contact->compliance = Compliance{.stiffness = 2e7};
  s.auxiliary[1].contact->compliance = Compliance{.stiffness = 3e7};
  test::add_constant_force(s, {300.0, 0.0});
  s.run.end = 4e-3;
  const Trajectory exact = run_event(s);
  ASSERT_GE(exact.impacts.size(), 2u);
  test::expect_order_of_steps(s, {8e-6, 4e-6, 2e-6, 1e-6, 5e-7}, 1.8,
                              [&](const Trajectory& t) { return test::rotor_error(t, exact); });
}

TEST(CompliantSteps, GiveTheFiguresOfEvent) {
  for (const Law& law : kLaws) {
    const scene::Scene s = thrown(law.compliance, law.friction);
    const Trajectory exact = run_event(s), t = run_with(s, Integrator::kVerlet, 2e-7);
    EXPECT_EQ(t.contact_model, "compliant");
    EXPECT_EQ(t.impacts.size(), exact.impacts.size()) << law.name;
    const Statistics &a = t.statistics, &b = exact.statistics;
    EXPECT_NEAR(a.peak_force / b.peak_force, 1.0, 2e-3) << law.name;
    EXPECT_NEAR(a.max_penetration / b.max_penetration, 1.0, 2e-3) << law.name;
    EXPECT_NEAR(a.contact_time / b.contact_time, 1.0, 5e-3) << law.name;
    EXPECT_NEAR(a.impulse_total / b.impulse_total, 1.0, 1e-3) << law.name;
    EXPECT_NEAR(a.friction_work, b.friction_work, 2e-3 * std::abs(b.friction_work)) << law.name;
    EXPECT_LT(a.energy_residual(), 1e-3) << law.name;
    EXPECT_LT(b.energy_residual(), 1e-9) << law.name;
  }
}

TEST(CompliantSteps, KeepTheirStepToTheStiffness) {
  scene::Scene s = thrown({.stiffness = 1e9}, 0.1);
  const Model model = prepare(s);
  // 1/m of rotor and ring: 2 kg and 0.8 kg.
  EXPECT_NEAR(step_limit(model).step, 2.0 / std::sqrt(1e9 * (1.0 / 2.0 + 1.0 / 0.8)), 1e-12);
  const Trajectory t = test::attempt_with(s, Integrator::kVerlet, 1e-4);
  EXPECT_EQ(t.status, Status::kStepTooLarge);
  EXPECT_NE(t.message.find("the contact's stiffness"), std::string::npos) << t.message;
  // In Hertz's law the stiffness is that of the depth.
  s.first().contact->compliance = Compliance{.stiffness = 1e11, .exponent = 1.5};
  EXPECT_EQ(test::attempt_with(s, Integrator::kVerlet, 1e-4).status, Status::kStepTooLarge);
}

TEST(CompliantSteps, OthersRefuseThem) {
  scene::Scene s = thrown({.stiffness = 4e6}, 0.1);
  const auto refused = test::refusals([&] { run_with(s, Integrator::kEuler); });
  ASSERT_EQ(refused.size(), 1u);
  EXPECT_EQ(refused[0].key, "contact.compliance");
}

// A rotor that flies straight into its wall: the touch is within a step.
TEST(CompliantSteps, KnowWhenTheyTouch) {
  scene::Scene s = make_scene({.clearance = 2e-4, .restitution = 1.0});
  s.first().contact->compliance = Compliance{.stiffness = 1e5};
  s.initial.vx = {0.1};
  s.run.end = 3e-3;
  const Trajectory run = run_with(s, Integrator::kVerlet, 6.1e-5);
  ASSERT_FALSE(run.events.empty());
  EXPECT_EQ(run.events.front().kind, EventKind::kImpact);
  EXPECT_NEAR(run.events.front().t, 2e-3, 1e-9);
}

}  // namespace
}  // namespace rotorub
