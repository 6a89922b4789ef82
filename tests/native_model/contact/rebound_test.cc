// When an accumulation of impacts ends: one rule for every engine.
#include "native_model/contact/rebound.h"

#include <gtest/gtest.h>

#include <cmath>

#include "native_model/run/run_native.h"
#include "native_model/scene/reader.h"

namespace rotorub {
namespace {

TEST(Rebound, PressingIsTheLoadAndTheTurningOfTheNormal) {
  // On a circle of 2 m at 3 m/s the centre falls away by 4.5 m/s^2.
  EXPECT_DOUBLE_EQ(pressing({1.0, 0.0}, {0.5, 3.0, 9.0}, {1.25, 7.0, 8.0}, 2.0), 1.25 + 4.5);
  EXPECT_DOUBLE_EQ(pressing({0.0, -1.0}, {3.0, 0.5, 9.0}, {7.0, -1.25, 8.0}, 2.0), 1.25 + 4.5);
}

TEST(Rebound, AFlightLastsTwiceItsSpeedOverWhatPresses) {
  EXPECT_TRUE(flight_outlives(0.99, 5.0, 10.0));
  EXPECT_FALSE(flight_outlives(1.0, 5.0, 10.0));
  EXPECT_TRUE(flight_outlives(1e9, 5.0, 0.0)) << "nothing presses";
  EXPECT_TRUE(flight_outlives(1e9, 5.0, -1.0));
  EXPECT_FALSE(flight_outlives(1.0, 0.0, 1.0)) << "no rebound at all";
}

// Impacts that are not located: what the fall of a step gives back to each.
TEST(Rebound, AnImpactThatFeedsItselfHasNoFlight) {
  const double h = 1e-5, load = 10.0;
  EXPECT_FALSE(rebound_outlives_steps(h, 0.5, 1.9e-4, load)) << "a flight of less than two steps";
  EXPECT_TRUE(rebound_outlives_steps(h, 0.5, 2.1e-4, load));
  EXPECT_FALSE(rebound_outlives_steps(h, 0.9, 9e-4, load)) << "0.1 v under a h";
  EXPECT_TRUE(rebound_outlives_steps(h, 0.9, 1.1e-3, load));
  EXPECT_TRUE(rebound_outlives_steps(h, 0.999, 3e-3, load)) << "a flight of 60 steps";
  EXPECT_TRUE(rebound_outlives_steps(h, 1.0, 2.1e-4, load)) << "nothing is lost";
}

// bench_drop thrown sideways: a mass bounces to rest on a ring and slides on. However long the step
// and however elastic the blows, lasting contact begins where the accumulation ends, and no impact
// follows. (Impacts that are not located are of first order, and each gives the next one a little
// more speed.)
TEST(Rebound, AnAccumulationEndsInLastingContact) {
  struct Case {
    const char* integrator;
    const char* step;
    double late;  // of the time in contact
  };
  constexpr Case kCases[] = {{"verlet", "1e-4", 0.07},   {"verlet", "2e-5", 0.02},
                             {"midpoint", "1e-4", 0.12}, {"midpoint", "2e-5", 0.08},
                             {"midpoint", "5e-6", 0.06}, {"euler", "1e-4", 0.12},
                             {"euler", "2e-5", 0.08},    {"literal", "5e-6", 0.06}};
  for (const char* restitution : {"0.1", "0.5", "0.6", "0.7", "0.8", "0.9"}) {
    const auto run = [&](const char* integrator, const char* step) {
      const std::vector<std::string> changes{"run.end=0.25",
                                             "initial.vx=[0.003]",
                                             "contact.friction=0.2",
                                             "rotor.speed=20.0",
                                             std::string("contact.restitution=") + restitution,
                                             std::string("run.integrator=\"") + integrator + "\"",
                                             std::string("run.step=") + step};
      return run_native(scene::read_scene(ROTORUB_MJCF_DIR "/bench_drop.toml", changes));
    };
    const Trajectory exact = run("event", "1e-5");
    for (const Case& c : kCases) {
      const Trajectory found = run(c.integrator, c.step);
      const std::string which = std::string(c.integrator) + " " + c.step + " eps " + restitution;
      EXPECT_LE(found.impacts.size(), exact.impacts.size()) << which;
      EXPECT_LT(found.impacts.back().t, exact.end - 0.85 * exact.statistics.contact_time) << which;
      EXPECT_NEAR(found.statistics.contact_time, exact.statistics.contact_time,
                  c.late * exact.statistics.contact_time)
          << which;
      EXPECT_NEAR(found.statistics.impulse_total, exact.statistics.impulse_total,
                  0.02 * exact.statistics.impulse_total)
          << which;
    }
  }
}

}  // namespace
}  // namespace rotorub
