// A rotor that rests under its weight: its loads are in balance, and what round-off leaves of them
// is no motion.
#include <gtest/gtest.h>

#include "tests/support/native_run.h"

namespace rotorub::test {
namespace {

// Perfectly balanced, held by a magnetic bearing: every step is iterated.
TEST(AtRest, TheEquationsOfAStepConverge) {
  const scene::Scene scene = shipped("touchdown", {"rotor.disc[0].eccentricity=0", "run.end=0.02"});
  for (const scene::Integrator i : {scene::Integrator::kVerlet, scene::Integrator::kMidpoint}) {
    for (const double step : {2e-5, 1e-5, 5e-6}) {
      const Trajectory t = run_with(scene, i, step);
      EXPECT_EQ(t.status, Status::kOk) << step << ": " << t.message;
      EXPECT_NEAR(t.column("rotor_y").back(), t.column("rotor_y").front(), 1e-12) << step;
    }
  }
}

}  // namespace
}  // namespace rotorub::test
