// A run that its explicit steps would take for ever ends with what holds them up; a short one goes
// on.
#include <gtest/gtest.h>

#include <string>
#include <vector>

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
    const Trajectory t = run_event(shipped("bench_ring", overrides));
    EXPECT_EQ(t.status, Status::kStepTooLarge) << part;
    EXPECT_NE(t.message.find(reason), std::string::npos) << part << ": " << t.message;
    EXPECT_LT(t.steps, 100000) << part;
  }
}

// Rates of 1e6 /s and 2.6e5 /s: 1e5 steps, of which it is right to take every one.
TEST(Stiffness, OfAShortRunIsNoReasonToStop) {
  for (const char* part : {"stator.spin={inertia=1e-6,drag=1.0}", "stator.mass=1e-3"}) {
    const scene::Scene scene = shipped("bench_ring", {part, "run.end=0.05"});
    const Trajectory t = run_event(scene);
    EXPECT_EQ(t.status, Status::kOk) << part << ": " << t.message;
    EXPECT_LT(rotor_error(t, run_with(scene, scene::Integrator::kVerlet, 1e-6)), 1e-8) << part;
  }
}

}  // namespace
}  // namespace rotorub::test
