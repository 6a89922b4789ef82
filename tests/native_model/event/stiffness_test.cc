// A run that would take explicit steps for ever ends with the reason; a short one continues.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "native_model/scene/reader.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"
#include "tests/support/order.h"

namespace rotorub::test {
namespace {

TEST(Stiffness, IsToldWithThePartThatHoldsTheStepsUp) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"stator.spin={inertia=1e-6,drag=1e3}", "the ring's spin follows within 1e-09 s"},
      {"stator.mass=1e-7", "the ring's motion follows within 5e-10 s"},
      {"drive={kind='linear',gain=1e6,speed='50 Hz'}", "the rotor's spin follows within 1e-1"},
  };
  for (const auto& [part, reason] : cases) {
    std::vector<std::string> overrides{part};
    if (part.starts_with("drive")) overrides.emplace_back("rotor.modal.inertia=1e-9");
    const Trajectory t = test::attempt_event(shipped("bench_ring", overrides));
    EXPECT_EQ(t.status, Status::kStepTooLarge) << part;
    EXPECT_NE(t.message.find(reason), std::string::npos) << part << ": " << t.message;
    EXPECT_LT(t.steps, 100000) << part;
  }
}

// Rates of 1e6 /s and 2.6e5 /s: 1e5 steps, all of which are necessary.
TEST(Stiffness, OfAShortRunIsNoReasonToStop) {
  for (const char* part : {"stator.spin={inertia=1e-6,drag=1.0}", "stator.mass=1e-3"}) {
    const scene::Scene scene = shipped("bench_ring", {part, "run.end=0.05"});
    const Trajectory t = run_event(scene);
    EXPECT_LT(rotor_error(t, run_with(scene, scene::Integrator::kVerlet, 1e-6)), 1e-8) << part;
  }
}

// A rotor pressed by 150 N at 300 rad/s into a compliant ring.
scene::Scene pressed(double stiffness, double ring_mass, double end) {
  scene::Scene s = make_scene({.damping = 40.0,
                               .stiffness = 2e5,
                               .radius = 0.02,
                               .friction = 0.1,
                               .restitution = 0.5,
                               .speed = 300.0});
  s.first().contact->compliance = Compliance{.stiffness = stiffness};
  add_ring(s, ring_mass, 10.0, 1e5);
  add_rotating_force(s, 150.0, 300.0);
  s.run.end = end;
  s.run.output_step = 1e-3;
  return s;
}

// A very light ring under a compliant contact. Round-off of its depth is more than the tolerance
// allows, so the steps shrank below what stability asks for, and nothing told that it was stiff.
TEST(Stiffness, OfALightRingInACompliantContactIsTold) {
  for (const double stiffness : {2e7, 1e11, 1e13}) {
    const Trajectory t = test::attempt_event(pressed(stiffness, 1e-9, 0.1));
    EXPECT_EQ(t.status, Status::kStepTooLarge) << stiffness;
    EXPECT_NE(t.message.find("the ring's motion follows within"), std::string::npos) << t.message;
    EXPECT_LT(t.steps, 200000) << stiffness;
  }
}

// In a contact of 1e15 N/m the depth is 1e-13 m, of which round-off leaves six digits: 8 ms of
// contact took 6 million steps.
TEST(Stiffness, OfAHardContactDoesNotResolveRoundOff) {
  const Trajectory t = run_event(pressed(1e15, 0.5, 0.013));
  EXPECT_LT(t.steps, 60000);
  EXPECT_LT(t.statistics.energy_residual(), 1e-9);
}

// Nothing ends the bouncing of an elastic contact. One that a fast mode pressed bounced within
// 1e-10 s, and its impacts filled the memory.
TEST(Stiffness, OfBouncesWithoutEndIsTold) {
  scene::Scene s = test::make_scene({.mass = 2.0, .stiffness = 2e5, .restitution = 1.0});
  s.run.end = 1e4;
  s.run.output_step = 1.0;
  test::add_constant_force(s, {0.0, -1e3});
  NativeOptions options;
  options.integrator = scene::Integrator::kEvent;
  options.event = EventParameters{.most_impacts = 1e4};
  const Trajectory t = run_native(s, options);
  EXPECT_EQ(t.status, Status::kStepTooLarge);
  EXPECT_NE(t.message.find("the rotor bounces without end"), std::string::npos) << t.message;
  EXPECT_LT(t.impacts.size(), 5000U);
  // An accumulation is faster, but ends.
  s.first().contact->restitution = 0.9;
  s.run.end = 1.0;
  EXPECT_EQ(run_native(s, options).status, Status::kOk);
}

}  // namespace
}  // namespace rotorub::test
