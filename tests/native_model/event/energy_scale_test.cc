// The residual of the energy balance is relative to the largest energy of the run, wherever it was.
#include <gtest/gtest.h>

#include "tests/native_model/hard/rules.h"
#include "tests/support/jeffcott.h"

namespace rotorub {
namespace {

constexpr double kBalance = 1e-10;

// From rest, pushed, and back to rest: next to nothing is left at either end.
TEST(EnergyScale, IsThatOfThePushThatIsOver) {
  scene::Scene scene =
      test::make_scene({.mass = 2.0, .damping = 400.0, .stiffness = 2e5, .clearance = 1.0});
  test::add_constant_force(scene, {100.0, 0.0});
  scene.forces[0].off = 0.05;
  scene.run.end = 0.5;
  const Trajectory t = test::run_event(scene);
  ASSERT_EQ(t.status, Status::kOk) << t.message;
  const double stored = 0.5 * 100.0 * 100.0 / 2e5;
  EXPECT_GT(t.statistics.energy_scale, stored);
  EXPECT_LT(t.statistics.energy_residual(), kBalance);
}

// The impact of the very first instant belongs to the run.
TEST(EnergyScale, TheImpactOfTheStartIsBooked) {
  for (const double tau : {0.0, 1e-4}) {
    SCOPED_TRACE(tau);
    scene::Scene scene = test::make_scene(
        {.mass = 2.0, .stiffness = 2e5, .friction = 0.2, .restitution = 0.5, .speed = 100.0});
    scene.first().contact->compression_time = tau;
    scene.initial.x = {0.5e-3};
    scene.initial.vx = {0.4};
    scene.run.end = 0.01;
    const Trajectory t = test::run_event(scene);
    ASSERT_EQ(t.status, Status::kOk) << t.message;
    ASSERT_GE(t.impacts.size(), 1u);
    EXPECT_EQ(t.impacts[0].t, 0.0);
    EXPECT_NEAR(t.statistics.energy_start, 0.5 * 2.0 * 0.16 + 0.5 * 2e5 * 0.25e-6, 1e-12);
    EXPECT_LT(t.statistics.energy_residual(), kBalance);
  }
}

}  // namespace
}  // namespace rotorub
